#include "server/room/channels.h"

#include <catch2/catch.hpp>

#include "tests/server/room/scene.h"

using namespace woodlouse;
using namespace woodlouse::server;
using protocol::Column;
using protocol::Format;

namespace {
const RowLayout kPlain{protocol::default_columns(), Format::kQuantized};
const RowLayout kExact{protocol::default_columns(), Format::kExact};
}  // namespace

TEST_CASE("clients of one layout share one frame a tick") {
  test::Scenery scenery(2);
  Channels channels;
  const auto a = channels.acquire(kPlain);
  const auto b = channels.acquire(kPlain);
  const auto c = channels.acquire(kExact);
  CHECK(a == b);
  CHECK(a != c);
  const auto frames = channels.encode(scenery.scene(), FrameKind::kKey);
  CHECK(frames.size() == 2);
  CHECK(channels.encoded() == 2);
}

TEST_CASE("a newcomer gets the last key and the last delta on it, without encoding them again") {
  test::Scenery scenery(2);
  Channels channels;
  const ChannelId id = channels.acquire(kPlain);
  CHECK(channels.newest(id, scenery.scene()).size() == 1);
  scenery.change();
  const auto delta = channels.encode(scenery.scene(), FrameKind::kDelta);
  const auto newest = channels.newest(id, scenery.scene());
  REQUIRE(newest.size() == 2);
  CHECK(newest[0].kind == FrameKind::kKey);
  CHECK(newest[1].text == delta[0].frame.text);
  CHECK(newest[1].base == newest[0].tick);
  CHECK(channels.encoded() == 2);
}

TEST_CASE("a layout without a key gets one where others get a delta") {
  test::Scenery scenery(2);
  Channels channels;
  channels.acquire(kPlain);
  CHECK(channels.encode(scenery.scene(), FrameKind::kDelta)[0].frame.kind == FrameKind::kKey);
  CHECK(channels.encode(scenery.scene(), FrameKind::kDelta)[0].frame.kind == FrameKind::kDelta);
}

TEST_CASE(
    "layouts are bounded, one more is served a wider one, and one that nobody uses any more makes room") {
  Channels channels;
  std::vector<ChannelId> ids;
  for (std::size_t i = 0; i < Channels::kMaxRareLayouts; ++i) {
    RowLayout layout{{Column::kId, Column::kPhase}, i % 2 ? Format::kExact : Format::kQuantized};
    for (std::size_t n = 0; n < i / 2; ++n) layout.fields.push_back(static_cast<Column>(1 + n));
    ids.push_back(channels.acquire(layout));
    CHECK(channels.layout(ids.back()) == layout);
  }
  // Whose columns a smaller and a larger one have; whose only every column has.
  const RowLayout contained{{Column::kId, Column::kVx}, Format::kExact};
  const ChannelId wider = channels.acquire(contained);
  CHECK(channels.layout(wider).fields ==
        std::vector{Column::kId, Column::kPhase, Column::kX, Column::kY, Column::kVx});
  CHECK(channels.layout(wider).format == Format::kExact);
  const RowLayout other{{Column::kId, Column::kSpeed, Column::kDistance}, Format::kExact};
  const ChannelId every = channels.acquire(other);
  CHECK(channels.layout(every).fields.size() == protocol::kColumnCount);
  const ChannelId own = channels.acquire({{Column::kId, Column::kDistance}, Format::kQuantized});
  CHECK(channels.layout(own).fields == protocol::all_columns());
  // The common ones are always there.
  for (const Format format : {Format::kExact, Format::kQuantized}) {
    for (const auto& fields : {protocol::default_columns(), protocol::all_columns()})
      CHECK(channels.layout(channels.acquire({fields, format})) == RowLayout{fields, format});
  }
  channels.release(ids[3]);
  CHECK(channels.layout(channels.acquire(other)) == other);
}
