#include "server/frames/frame_encoder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "shared/core/random.h"
#include "shared/core/stable_hash.h"
#include "shared/physics/attitude.h"
#include "shared/protocol/codec.h"
#include "shared/terrain/bicubic_spline.h"
#include "tests/server/frames/scene.h"

using namespace woodlouse;
using namespace woodlouse::server;
using protocol::Column;
using protocol::Format;

namespace {

protocol::Frame decode(const Frame& frame, const RowLayout& layout) {
  const std::string_view text(*frame.text);
  REQUIRE(text.back() == '\n');
  const auto message = protocol::decode_server(text.substr(0, text.size() - 1), layout.fields, layout.format);
  if (!message) FAIL(message.error().text << "\n" << text);
  return std::get<protocol::Frame>(*message);
}

using Rows = std::map<std::uint32_t, std::vector<double>>;

void absorb(Rows& rows, const protocol::Frame& frame) {
  if (frame.is_key) rows.clear();
  for (std::size_t i = 0; i < frame.rows(); ++i) {
    const auto begin = frame.values.begin() + static_cast<std::ptrdiff_t>(i * frame.columns);
    const std::vector<double> row(begin, begin + static_cast<std::ptrdiff_t>(frame.columns));
    rows[static_cast<std::uint32_t>(row[0])] = row;
  }
  for (const std::uint32_t id : frame.gone) REQUIRE(rows.erase(id) == 1);
}

}  // namespace

TEST_CASE("a key and any one delta on it show the same as a key of that tick would") {
  const Format format = GENERATE(Format::kQuantized, Format::kExact);
  const std::vector<std::vector<Column>> choices = {protocol::default_columns(),
                                                    protocol::all_columns(),
                                                    {Column::kId, Column::kZ, Column::kYaw, Column::kSpeed}};
  const RowLayout layout{choices[GENERATE(range(0u, 3u))], format};
  test::Scenery scenery(11);
  FrameEncoder encoder(layout);
  FrameEncoder fresh(layout);
  const protocol::Frame key = decode(encoder.key(scenery.scene()), layout);
  for (int i = 0; i < 50; ++i) {
    scenery.change();
    Rows rows;
    absorb(rows, key);
    absorb(rows, decode(encoder.delta(scenery.scene()), layout));
    Rows wanted;
    absorb(wanted, decode(fresh.key(scenery.scene()), layout));
    REQUIRE(rows == wanted);
  }
}

TEST_CASE("a delta leaves out what is as in the key, and what differs only in columns nobody asked for") {
  test::Scenery scenery(5);
  FrameEncoder encoder({{Column::kId, Column::kX}, Format::kQuantized});
  encoder.key(scenery.scene());
  ++scenery.tick;
  for (state::Louse& louse : scenery.lice) louse.distance += 1.0;
  const Frame delta = encoder.delta(scenery.scene());
  CHECK(*delta.text == R"({"type":"delta","tick":)" + std::to_string(scenery.tick) +
                           R"(,"base":0,"louse":[],"gone":[]})" + "\n");
}

TEST_CASE("a change below the quantum is left out of a quantized delta and stands in an exact one") {
  test::Scenery scenery(5);
  scenery.lice.resize(1);
  scenery.lice[0].position.x = 1.0;
  FrameEncoder quantized({protocol::default_columns(), Format::kQuantized});
  FrameEncoder exact({protocol::default_columns(), Format::kExact});
  quantized.key(scenery.scene());
  exact.key(scenery.scene());
  scenery.lice[0].position.x += 1e-5;
  CHECK(decode(quantized.delta(scenery.scene()), quantized.layout()).rows() == 0);
  CHECK(decode(exact.delta(scenery.scene()), exact.layout()).rows() == 1);
}

TEST_CASE("quantized values are within half a quantum, exact ones are the same bits") {
  test::Scenery scenery(9);
  std::vector<Column> columns = protocol::all_columns();
  columns.insert(columns.end(), {Column::kZ, Column::kYaw, Column::kPitch, Column::kRoll, Column::kSpeed});
  for (const Format format : {Format::kQuantized, Format::kExact}) {
    FrameEncoder encoder({columns, format});
    const protocol::Frame frame = decode(encoder.key(scenery.scene()), encoder.layout());
    REQUIRE(frame.rows() == scenery.lice.size());
    for (std::size_t i = 0; i < frame.rows(); ++i) {
      const std::vector<double> wanted = test::values(scenery.lice[i], columns, scenery.terrain);
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const double got = frame.values[i * columns.size() + c];
        if (format == Format::kExact)
          REQUIRE(got == wanted[c]);
        else
          REQUIRE(std::abs(got - wanted[c]) <= 0.5 * protocol::quantum(columns[c]));
      }
    }
  }
}

TEST_CASE("a key of all columns in exact format recomputes the state hash") {
  test::Scenery scenery(21);
  core::StableHasher hasher;
  scenery.link = {17, 18, 20, 0, scenery.tick, 19};
  scenery.hash = state::state_hash(hasher, scenery.link, scenery.lice);
  const RowLayout layout{protocol::all_columns(), Format::kExact};
  FrameEncoder encoder(layout);
  const Frame frame = encoder.key(scenery.scene());
  const protocol::Frame decoded = decode(frame, layout);

  std::vector<state::Louse> lice;
  for (std::size_t i = 0; i < decoded.rows(); ++i) {
    lice.push_back(state::louse_of(std::span(decoded.values).subspan(i * decoded.columns, decoded.columns)));
  }
  CHECK(decoded.hash == state::state_hash(hasher, scenery.link, lice));
  CHECK_THAT(*frame.text,
             Catch::Contains(
                 R"("previous":"0000000000000011","inputs":"0000000000000012","roster":"0000000000000014",)"
                 R"("rules":"0000000000000000","link":0,"generator":"0000000000000013")"));
}

TEST_CASE("an empty room has empty frames") {
  test::Scenery scenery(1);
  FrameEncoder encoder({protocol::default_columns(), Format::kQuantized});
  const protocol::Frame full = decode(encoder.key(scenery.scene()), encoder.layout());
  const std::size_t count = scenery.lice.size();
  scenery.lice.clear();
  ++scenery.tick;
  const protocol::Frame delta = decode(encoder.delta(scenery.scene()), encoder.layout());
  CHECK(full.rows() == count);
  CHECK(delta.rows() == 0);
  CHECK(delta.gone.size() == count);
  CHECK(decode(encoder.key(scenery.scene()), encoder.layout()).rows() == 0);
}
