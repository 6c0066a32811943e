#include "server/frames/viewer.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "server/frames/sheet_encoder.h"
#include "shared/core/random.h"
#include "shared/protocol/codec.h"
#include "tests/server/frames/scene.h"

namespace woodlouse::server::viewer_test {
namespace {

using protocol::Column;
using Rows = std::map<std::uint32_t, std::vector<double>>;

const RowLayout kLayout{protocol::default_columns(), protocol::Format::kQuantized, true};

protocol::Frame decode(const Frame& frame) {
  REQUIRE(frame.text);
  std::string_view text(*frame.text);
  REQUIRE(text.back() == '\n');
  text.remove_suffix(1);
  const auto message = protocol::decode_server(text, kLayout.fields, kLayout.format);
  if (!message) FAIL(message.error().text << "\n" << text);
  return std::get<protocol::Frame>(*message);
}

/// A client: what it makes of the frames that it gets.
struct Client {
  Rows key, rows;
  std::uint64_t key_tick = 0;

  void take(const protocol::Frame& frame) {
    if (frame.is_key) {
      key = read(frame);
      key_tick = frame.tick;
      rows = key;
      return;
    }
    REQUIRE(frame.base == key_tick);
    rows = key;
    for (const std::uint32_t id : frame.gone) REQUIRE(rows.erase(id) == 1);
    for (auto& [id, row] : read(frame)) rows[id] = row;
  }
  static Rows read(const protocol::Frame& frame) {
    Rows rows;
    for (std::size_t k = 0; k < frame.rows(); ++k) {
      const auto begin = frame.values.begin() + static_cast<std::ptrdiff_t>(k * frame.columns);
      const auto id = static_cast<std::uint32_t>(*begin);
      REQUIRE(rows.emplace(id, std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(frame.columns)))
                  .second);
    }
    return rows;
  }
};

/// Who is to be seen, by its definition: every distance looked at.
std::vector<std::uint32_t> wanted_ids(const Scene& scene, const protocol::View& view, std::uint32_t own,
                                      core::Vec2 middle, core::Vec2 period) {
  struct Near {
    double square;
    std::uint32_t id;
  };
  std::vector<Near> all;
  for (const state::Louse& louse : scene.lice) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const double x : {-period.x, 0.0, period.x})
      for (const double y : {-period.y, 0.0, period.y}) {
        const core::Vec2 way = louse.position - (middle + core::Vec2{x, y});
        nearest = std::min(nearest, core::dot(way, way));
      }
    if (louse.id == own) nearest = -1.0;
    if (louse.id == own || !view.radius || nearest <= *view.radius * *view.radius)
      all.push_back({nearest, louse.id});
  }
  std::sort(all.begin(), all.end(), [](const Near& a, const Near& b) {
    return a.square != b.square ? a.square < b.square : a.id < b.id;
  });
  if (view.rows && all.size() > *view.rows) all.resize(*view.rows);
  std::vector<std::uint32_t> ids;
  for (const Near& one : all) ids.push_back(one.id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::vector<std::uint32_t> ids_of(const Rows& rows) {
  std::vector<std::uint32_t> ids;
  for (const auto& [id, row] : rows) ids.push_back(id);
  return ids;
}

}  // namespace

TEST_CASE("a view shows who is nearest by its definition, whatever moves, comes, goes, or is looked at") {
  const bool wraps = GENERATE(false, true);
  const bool with_own = GENERATE(false, true);
  test::Scenery scenery(wraps ? 5 : 6);
  core::Random random(with_own ? 17 : 18);
  const std::uint32_t own = with_own ? 3 : 0;
  SheetEncoder encoder(kLayout);
  FrameEncoder whole({kLayout.fields, kLayout.format});
  protocol::View view;
  Viewer viewer(view, own, protocol::kEveryRow);
  Client client, everything;
  core::Vec2 seen_last{};
  bool was_seen = false;
  for (int step = 0; step < 400; ++step) {
    scenery.change();
    if (random.uniform() < 0.5) {
      view = {};
      const double kind = random.uniform();
      if (kind < 0.4) view.place = core::Vec2{50.0 * random.uniform() - 25.0, 50.0 * random.uniform() - 25.0};
      if (kind > 0.7) view.louse = 1 + static_cast<std::uint32_t>(40.0 * random.uniform());
      if (random.uniform() < 0.7) view.radius = 0.1 + 30.0 * random.uniform();
      if (random.uniform() < 0.6) view.rows = 1 + static_cast<std::uint32_t>(12.0 * random.uniform());
      viewer.look(view);
    }
    Scene scene = scenery.scene();
    scene.wraps = wraps;
    const bool is_key = step == 0 || random.uniform() < 0.1;
    const Frame sheet = is_key ? encoder.key(scene) : encoder.delta(scene);
    const auto frame = viewer.frame(sheet);
    REQUIRE(frame);
    client.take(decode(*frame));
    everything.take(decode(is_key ? whole.key(scene) : whole.delta(scene)));

    const std::uint32_t followed = view.louse.value_or(own);
    for (const state::Louse& louse : scene.lice)
      if (!view.place && louse.id == followed) seen_last = louse.position, was_seen = true;
    core::Vec2 middle = was_seen ? seen_last : core::Vec2{};
    if (view.place) middle = *view.place;
    const core::Vec2 period = wraps ? core::Vec2{40.0, 40.0} : core::Vec2{};
    REQUIRE(ids_of(client.rows) == wanted_ids(scene, view, own, middle, period));
    for (const auto& [id, row] : client.rows) REQUIRE(everything.rows.at(id) == row);
  }
}

TEST_CASE("a delta holds no row that the client's key has already") {
  test::Scenery scenery(3);
  SheetEncoder encoder(kLayout);
  Viewer viewer({}, 0, protocol::kEveryRow);
  viewer.frame(encoder.key(scenery.scene()));
  ++scenery.tick;
  scenery.lice[4].position.x += 1.0;
  const auto frame = viewer.frame(encoder.delta(scenery.scene()));
  REQUIRE(frame);
  CHECK(decode(*frame).rows() == 1);
  CHECK(decode(*frame).gone.empty());
  // Out of sight, then in sight again: as a row that is in the key.
  protocol::View nothing;
  nothing.place = core::Vec2{1e300, -1e300};
  nothing.radius = 1.0;
  viewer.look(nothing);
  const auto empty = viewer.frame(encoder.delta(scenery.scene()));
  CHECK(decode(*empty).gone.size() == scenery.lice.size());
  viewer.look({});
  CHECK(decode(*viewer.frame(encoder.delta(scenery.scene()))).rows() == 1);
}

TEST_CASE("a delta on a key that the client was not shown is no frame of his") {
  test::Scenery scenery(3);
  SheetEncoder encoder(kLayout);
  Viewer viewer({}, 0, 10);
  const Frame first = encoder.key(scenery.scene());
  const Frame delta = encoder.delta(scenery.scene());
  CHECK_FALSE(viewer.frame(delta));
  REQUIRE(viewer.frame(first));
  CHECK(viewer.frame(delta));
  ++scenery.tick;
  encoder.key(scenery.scene());
  CHECK_FALSE(viewer.frame(encoder.delta(scenery.scene())));
}

TEST_CASE("the nearest of lice that stand on one place are those of the lowest ids") {
  test::Scenery scenery(9);
  for (state::Louse& louse : scenery.lice) louse.position = {1.0, 2.0};
  SheetEncoder encoder(kLayout);
  protocol::View view;
  view.rows = 5;
  Viewer viewer(view, 20, protocol::kEveryRow);
  Client client;
  client.take(decode(*viewer.frame(encoder.key(scenery.scene()))));
  CHECK(ids_of(client.rows) == std::vector<std::uint32_t>{1, 2, 3, 4, 20});
  scenery.lice.clear();
  client.take(decode(*viewer.frame(encoder.key(scenery.scene()))));
  CHECK(client.rows.empty());
}

TEST_CASE("keys and deltas of a sheet carry the hash and what the rules say") {
  test::Scenery scenery(9);
  Scene scene = scenery.scene();
  scene.game.emplace();
  scene.game->game.phase = protocol::GamePhase::kPlay;
  scene.game->game.round = 2;
  scene.game->standings.resize(scene.lice.size());
  SheetEncoder encoder({{Column::kId, Column::kScore}, protocol::Format::kQuantized, true});
  Viewer viewer({}, 0, protocol::kEveryRow);
  const auto key = viewer.frame(encoder.key(scene));
  CHECK(key->text->find(R"("hash":"0000000000001267")") != std::string::npos);
  CHECK(key->text->find(R"("round":2)") != std::string::npos);
  scene.game->game.round = 3;
  scene.game->standings[2].score = 77;
  const auto delta = viewer.frame(encoder.delta(scene));
  CHECK(delta->text->find(R"("round":3)") != std::string::npos);
  CHECK(delta->text->find("[3,77]") != std::string::npos);
}

}  // namespace woodlouse::server::viewer_test
