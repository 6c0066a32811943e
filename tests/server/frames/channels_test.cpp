#include "server/frames/channels.h"

#include <catch2/catch.hpp>

#include "tests/server/frames/scene.h"

using namespace woodlouse;
using namespace woodlouse::server;
using protocol::Format;

namespace {
const RowLayout kPlain{protocol::default_columns(), Format::kQuantized};
const RowLayout kExact{protocol::default_columns(), Format::kExact};
}  // namespace

TEST_CASE("each open layout has one frame a tick, until it is closed") {
  test::Scenery scenery(2);
  Channels channels;
  channels.open(1, kPlain);
  channels.open(2, kExact);
  CHECK(channels.encode(scenery.scene(), FrameKind::kKey).size() == 2);
  CHECK(channels.encoded() == 2);
  channels.close(1);
  const auto frames = channels.encode(scenery.scene(), FrameKind::kKey);
  REQUIRE(frames.size() == 1);
  CHECK(frames[0].channel == 2);
}

TEST_CASE("a newcomer gets the last key and the last delta on it, without encoding them again") {
  test::Scenery scenery(2);
  Channels channels;
  channels.open(1, kPlain);
  CHECK(channels.newest(1, scenery.scene()).size() == 1);
  scenery.change();
  const auto delta = channels.encode(scenery.scene(), FrameKind::kDelta);
  const auto newest = channels.newest(1, scenery.scene());
  REQUIRE(newest.size() == 2);
  CHECK(newest[0].kind == FrameKind::kKey);
  CHECK(newest[1].text == delta[0].frame.text);
  CHECK(newest[1].base == newest[0].tick);
  CHECK(channels.encoded() == 2);
}

TEST_CASE("a layout without a key gets one where others get a delta") {
  test::Scenery scenery(2);
  Channels channels;
  channels.open(1, kPlain);
  CHECK(channels.encode(scenery.scene(), FrameKind::kDelta)[0].frame.kind == FrameKind::kKey);
  CHECK(channels.encode(scenery.scene(), FrameKind::kDelta)[0].frame.kind == FrameKind::kDelta);
}
