#include "client/watch/player.h"

#include <catch2/catch.hpp>
#include <string>

#include "shared/map/map_file.h"
#include "shared/match/match.h"
#include "shared/replay/writer.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace std::chrono_literals;

namespace {

const core::Time kStart{std::chrono::seconds(100)};
constexpr std::uint64_t kTicks = 1200;

/// Twenty seconds of three lice that drive: a bot and ada from the start, lin from 10 s on; ada says
/// something at 5 s, begins again at 8 s and leaves at 15 s.
std::string recorded() {
  const auto map = map::load_map(std::string(WOODLOUSE_SOURCE_DIR) + "/maps/volcano.json");
  REQUIRE(map);
  match::Match match(*map, {60, 11});
  replay::ReplayWriter writer;
  std::string bytes;
  writer.append_header(bytes, replay::make_header(match, "test", "volcano.json"));
  writer.append_keyframe(bytes, match.state());
  match.join({"gauss", state::Role::kBot});
  match.join({"ada", state::Role::kPlayer});
  for (std::uint32_t tick = 0; tick < kTicks; ++tick) {
    if (tick == 300) writer.append_chat(bytes, tick, 0, "eve", "I only watch");
    if (tick == 300) writer.append_chat(bytes, tick, 2, "ada", "on your tail");
    if (tick == 480) match.respawn(2);
    if (tick == 600) match.join({"lin", state::Role::kPlayer});
    if (tick == 900) match.leave(2);
    if (tick % 30 == 5)
      match.file({1, tick, {state::ThrustKind::kMapVector, {0.5, tick % 60 == 5 ? 0.25 : -0.5}}, 20, 0});
    writer.append_step(bytes, match.advance());
    if (match.tick() % replay::keyframe_ticks(60) == 0) writer.append_keyframe(bytes, match.state());
  }
  writer.append_end(bytes, "ticks done");
  writer.flush(bytes);
  return bytes;
}

std::unique_ptr<RecordingView> opened(std::string bytes) {
  auto view = RecordingView::open(replay::ReplaySource::of_bytes(std::move(bytes), "test.ndjson"));
  if (!view) FAIL(view.error().text());
  return std::move(*view);
}

Key letter(char32_t c) { return {.character = c}; }

FrameFacts facts() { return {Look{}, 30.0, false, kStart}; }

/// Presses the key and lets it show.
void press(Screening& screening, char32_t c) {
  REQUIRE_FALSE(screening.on_key(letter(c)));
  screening.update(kStart);
}

/// The same recording with the first step's line that has `field` changed by `change`.
template <typename Change>
std::string altered(std::string bytes, const std::string& line_start, const std::string& field,
                    Change change) {
  const std::size_t line = bytes.find(line_start);
  REQUIRE(line != std::string::npos);
  const std::size_t place = bytes.find(field, line);
  REQUIRE(place != std::string::npos);
  change(bytes[place + field.size()]);
  return bytes;
}

}  // namespace

TEST_CASE("a recording plays and shows who was there, when, and what was said") {
  const auto view = opened(recorded());
  Screening screening(*view, "test.ndjson", View::kMap);
  core::Time now = kStart;
  screening.update(now);
  CHECK(screening.scene(facts()).lice.empty());
  for (int frame = 0; frame < 60; ++frame) screening.update(now += 100ms);
  const Scene scene = screening.scene(facts());
  CHECK(screening.clock().tick() == 360);
  REQUIRE(scene.lice.size() == 2);
  CHECK(scene.lice[0].name == "gauss");
  CHECK(scene.lice[0].kind == LouseKind::kBot);
  CHECK(scene.lice[0].trail.size() > 3);
  CHECK(scene.lice[1].name == "ada");
  REQUIRE(scene.chat.size() == 4);
  CHECK(scene.chat[0].text == "bot gauss joined");
  CHECK(scene.chat[2].from == "eve");  // no player, so without a number
  CHECK(scene.chat[3].from == "ada");
  CHECK(scene.chat[3].text == "on your tail");
  REQUIRE(scene.replay);
  CHECK(scene.replay->playing);
  CHECK(scene.replay->seconds == Approx(6.0));
  CHECK(scene.replay->total_seconds == Approx(20.0));
  REQUIRE(scene.replay->marks->size() == 7);
  CHECK(scene.replay->marks->at(2).sign == EventSign::kChat);
  REQUIRE(scene.proof);
  CHECK(scene.proof->verified == 360);
  CHECK(*scene.proof->total == kTicks);
  CHECK_FALSE(scene.proof->differs);
}

TEST_CASE("wherever one jumps, the lice stand where playing through would have put them") {
  const std::string bytes = recorded();
  const auto played = opened(bytes);
  const auto jumped = opened(bytes);
  Screening screening(*jumped, "test.ndjson", View::kMap);
  for (const char32_t digit : {U'9', U'2', U'7', U'0', U'5'}) {
    press(screening, digit);
    const std::uint64_t tick = screening.clock().tick();
    CHECK(tick == (digit - U'0') * kTicks / 10);
    REQUIRE(played->show(0));
    while (played->tick() < tick) REQUIRE(played->show(played->tick() + 1));
    REQUIRE(jumped->sight().lice.size() == played->sight().lice.size());
    for (const auto& [id, louse] : played->sight().lice) {
      CHECK(jumped->sight().lice.at(id).sample.position.x == louse.sample.position.x);
      CHECK(jumped->sight().lice.at(id).sample.velocity.y == louse.sample.velocity.y);
    }
  }
}

TEST_CASE("ticks are stepped forth and back, and back again is the same") {
  const auto view = opened(recorded());
  Screening screening(*view, "test.ndjson", View::kMap);
  press(screening, U'5');
  const core::Vec2 before = view->sight().lice.at(1).sample.position;
  press(screening, U'.');
  CHECK_FALSE(screening.clock().is_playing());
  CHECK(view->tick() == 601);
  CHECK(view->sight().lice.at(1).sample.position.x != before.x);
  press(screening, U',');
  CHECK(view->tick() == 600);
  CHECK(view->sight().lice.at(1).sample.position.x == before.x);
  CHECK(view->sight().lice.at(1).sample.position.y == before.y);
}

TEST_CASE("n goes from event to event, forth and back") {
  const auto view = opened(recorded());
  Screening screening(*view, "test.ndjson", View::kMap);
  press(screening, U' ');
  for (const std::uint64_t tick : {1u, 301u, 481u, 601u, 901u, 901u}) {
    press(screening, U'n');
    CHECK(screening.clock().tick() == tick);
  }
  for (const std::uint64_t tick : {601u, 481u, 301u, 1u, 0u}) {
    press(screening, U'N');
    CHECK(screening.clock().tick() == tick);
  }
}

TEST_CASE("f follows the next louse and Shift-F the one before, with its numbers in the panel") {
  const auto view = opened(recorded());
  Screening screening(*view, "test.ndjson", View::kMap);
  press(screening, U'6');  // gauss, ada and lin are there
  const std::uint32_t leader = screening.scene(facts()).follow_id;
  press(screening, U'f');
  CHECK(screening.interface().view == View::kFollow);
  const Scene followed = screening.scene(facts());
  CHECK(followed.follow_id == leader % 3 + 1);
  CHECK(followed.hud.distance == view->louse(followed.follow_id)->distance);
  press(screening, U'F');
  CHECK(screening.scene(facts()).follow_id == leader);
  press(screening, U'F');
  CHECK(screening.scene(facts()).follow_id == (leader + 1) % 3 + 1);
}

TEST_CASE("E counts how far the followed louse's steps err, over what is played, and a jump begins anew") {
  const auto view = opened(recorded());
  Screening screening(*view, "test.ndjson", View::kMap);
  core::Time now = kStart;
  screening.update(now);
  for (int frame = 0; frame < 20; ++frame) screening.update(now += 100ms);
  CHECK_FALSE(screening.scene(facts()).hud.asks_error);
  const auto press_now = [&](char32_t c) {
    REQUIRE_FALSE(screening.on_key(letter(c)));
    screening.update(now);
  };
  press_now(U'f');
  press_now(U'e');
  CHECK(screening.scene(facts()).hud.asks_error);
  CHECK_FALSE(screening.scene(facts()).hud.error);
  for (int frame = 0; frame < 30; ++frame) screening.update(now += 100ms);
  const auto error = screening.scene(facts()).hud.error;
  REQUIRE(error);
  CHECK(error->seconds == Approx(3.0));
  CHECK(error->worst_tick >= 120);
  CHECK(error->worst_tick < 300);
  CHECK(error->apart_seconds == Approx(3.0));
  press_now(U'>');  // 5 s forth
  CHECK_FALSE(screening.scene(facts()).hud.error);
  for (int frame = 0; frame < 10; ++frame) screening.update(now += 100ms);
  CHECK(screening.scene(facts()).hud.error->seconds == Approx(1.0));
  press_now(U'f');  // another louse
  CHECK_FALSE(screening.scene(facts()).hud.error);
  for (int frame = 0; frame < 5; ++frame) screening.update(now += 100ms);
  CHECK(screening.scene(facts()).hud.error);
  press_now(U'e');
  CHECK_FALSE(screening.scene(facts()).hud.asks_error);
  CHECK_FALSE(view->error());
}

TEST_CASE("proving ahead proves every tick once, whatever is shown, and knows what will be said") {
  const auto view = opened(recorded());
  Screening screening(*view, "test.ndjson", View::kMap);
  press(screening, U'8');
  view->prove(core::Time::max());
  press(screening, U'3');
  const Scene scene = screening.scene(facts());
  CHECK(scene.proof->verified == kTicks);
  CHECK(*scene.proof->total == kTicks);
  CHECK(scene.chat.back().text == "on your tail");
}

TEST_CASE("a flipped digit of a hash is told with its tick") {
  const std::string bytes = altered(recorded(), R"({"step":700,)", R"("hash":")",
                                    [](char& digit) { digit = digit == '0' ? '1' : '0'; });
  const auto view = opened(bytes);
  Screening screening(*view, "test.ndjson", View::kMap);
  view->prove(core::Time::max());
  const Scene scene = screening.scene(facts());
  REQUIRE(scene.proof->differs);
  CHECK(*scene.proof->differs == 701);
  CHECK(scene.notice.find("state DIFFERS at tick 701: ") == 0);
}

TEST_CASE(
    "an input that was altered differs at the tick its step leads to, and a later jump does not hide it") {
  const std::string bytes =
      altered(recorded(), R"({"step":605,)", R"("inputs":[[1,605,[)", [](char& digit) { --digit; });
  const auto view = opened(bytes);
  Screening screening(*view, "test.ndjson", View::kMap);
  press(screening, U'5');
  core::Time now = kStart;
  for (int frame = 0; frame < 10; ++frame) screening.update(now += 100ms);
  press(screening, U'9');
  REQUIRE(screening.scene(facts()).proof->differs);
  CHECK(*screening.scene(facts()).proof->differs == 606);
}

TEST_CASE("a recording that is damaged in the middle is shown up to there and says why it stops") {
  const std::string bytes =
      altered(recorded(), R"({"step":700,)", R"("step":7)", [](char& digit) { digit = 'x'; });
  const auto view = opened(bytes);
  Screening screening(*view, "test.ndjson", View::kMap);
  press(screening, U'5');
  core::Time now = kStart;
  for (int frame = 0; frame < 60; ++frame) screening.update(now += 100ms);
  CHECK(view->tick() == 700);
  CHECK_FALSE(screening.clock().is_playing());
  CHECK_FALSE(screening.scene(facts()).notice.empty());
}

TEST_CASE("what is no recording is an error that names the file") {
  for (const char* bytes : {"", "hello\n", "{\"format\":\"woodlouse-replay\",\"version\":99}\n"}) {
    const auto view = RecordingView::open(replay::ReplaySource::of_bytes(bytes, "odd.ndjson"));
    REQUIRE_FALSE(view);
    CHECK(view.error().where.find("odd.ndjson") == 0);
  }
}

TEST_CASE("q leaves, the terminal's keys go to who runs it") {
  const auto view = opened(recorded());
  Screening screening(*view, "test.ndjson", View::kMap);
  CHECK(screening.on_key(letter(U'q')) == Action::kConfirm);
  CHECK(screening.on_key({.character = U'z', .control = true}) == Action::kSuspend);
  CHECK_FALSE(screening.on_key(letter(U'?')));
  CHECK(screening.scene(facts()).mode == Mode::kHelp);
  CHECK_FALSE(screening.on_key(letter(U'q')));
  CHECK(screening.scene(facts()).mode == Mode::kPlay);
}
