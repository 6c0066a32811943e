// Steps that did nothing: in one line, read one by one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "shared/map/map_file.h"
#include "shared/replay/inspect.h"
#include "shared/replay/line_reader.h"
#include "shared/replay/parallel_verify.h"
#include "shared/replay/writer.h"
#include "tests/replay/recorded_match.h"

namespace woodlouse::replay {
namespace {

/// Of the first of such lines.
std::string refusal(const std::string& step) {
  std::istringstream in("{\"step\":1," + step + ",\"hash\":\"0000000000000001\"}\n");
  ReplayReader reader(in, "r");
  const auto line = reader.next();
  return line ? "no error" : line.error().text();
}

struct Rests {
  std::string bytes;
  std::vector<std::string> states;  ///< of each tick
};

/// Nobody is there; somebody comes and stands; another comes, and goes while somebody speaks; all is still.
Rests played_at_rest(Encoding encoding) {
  const auto level = map::parse_map(R"({"name":"level","terrain":{"spacing":9,"heights":)"
                                    R"([[0,0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,0]]}})",
                                    "level.json", {});
  REQUIRE(level);
  match::Match match(*level, {60, 3});
  ReplayWriter writer(encoding);
  Rests rests;
  writer.append_header(rests.bytes, make_header(match, "tests", "level.json"));
  writer.append_keyframe(rests.bytes, match.state());
  rests.states.push_back(state_text(match.state()));
  while (match.tick() < 800) {
    if (match.tick() == 130) match.join({"ada", state::Role::kPlayer});
    if (match.tick() == 299) match.join({"bob", state::Role::kBot});
    if (match.tick() == 511) match.leave(2);
    if (match.tick() == 520) match.file({1, 1, {state::ThrustKind::kNone, {}}, state::kHeld, 575});
    if (match.tick() == 450 || match.tick() == 511)
      writer.append_chat(rests.bytes, match.tick(), 1, "ada", "so quiet");
    writer.append_step(rests.bytes, match.advance());
    rests.states.push_back(state_text(match.state()));
    if (match.tick() % 150 == 0) writer.append_keyframe(rests.bytes, match.state());
    if (match.tick() % 64 == 0) writer.flush(rests.bytes);
  }
  writer.append_end(rests.bytes, "test over");
  return rests;
}

std::string verdict_by(const std::string& bytes, unsigned jobs) {
  const auto verification = verify(ReplaySource::of_bytes(bytes, "r.jsonl"), jobs);
  return verification ? to_text(*verification) : verification.error().text();
}

}  // namespace

TEST_CASE("steps that changed nothing stand in one line and are read one by one") {
  ReplayWriter writer;
  std::string out;
  const auto step = [&](std::uint64_t tick, std::uint64_t hash) {
    match::StepRecord record;
    record.tick = tick;
    record.hash = hash;
    writer.append_step(out, record);
  };
  step(7, 5);
  for (std::uint64_t tick = 8; tick < 20; ++tick) step(tick, 5);
  writer.append_chat(out, 20, 1, "ada", "so quiet");
  step(20, 5);
  step(21, 6);
  for (std::uint64_t tick = 22; tick < 25; ++tick) step(tick, 6);
  writer.flush(out);
  step(25, 6);
  writer.flush(out);
  CHECK(out ==
        "{\"step\":7,\"hash\":\"0000000000000005\"}\n"
        "{\"step\":8,\"steps\":12,\"hash\":\"0000000000000005\"}\n"
        "{\"chat\":20,\"player\":1,\"name\":\"ada\",\"text\":\"so quiet\"}\n"
        "{\"step\":20,\"hash\":\"0000000000000005\"}\n"
        "{\"step\":21,\"hash\":\"0000000000000006\"}\n"
        "{\"step\":22,\"steps\":3,\"hash\":\"0000000000000006\"}\n"
        "{\"step\":25,\"hash\":\"0000000000000006\"}\n");
  std::istringstream in(out);
  ReplayReader reader(in, "r");
  std::uint64_t due = 7;
  std::size_t chats = 0;
  for (auto line = reader.next(); line && line->has_value(); line = reader.next()) {
    if (std::holds_alternative<ChatLine>(**line)) ++chats;
    const auto* read = std::get_if<StepLine>(&**line);
    if (read == nullptr) continue;
    CHECK(read->step.tick == due++);
    CHECK(read->steps == 1);
    CHECK(read->step.hash == (read->step.tick < 21 ? 5 : 6));
  }
  CHECK(due == 26);
  CHECK(chats == 1);
}

TEST_CASE(
    "a line of many steps is one of steps that did nothing, and of no more than stand between keyframes") {
  CHECK(refusal("\"steps\":1").find("r:1: steps: ") == 0);
  CHECK(refusal("\"steps\":5001").find("r:1: steps: ") == 0);
  CHECK(refusal("\"steps\":2,\"roster\":[{\"leave\":1}]").find("r:1: steps: ") == 0);
  CHECK(refusal("\"steps\":2,\"inputs\":[[1,1,null]]").find("r:1: steps: ") == 0);
}

TEST_CASE("a respawn is at a gate or says nothing of where") {
  CHECK(refusal("\"roster\":[{\"respawn\":1,\"at\":\"spawn\"}]").find("r:1: roster") == 0);
  CHECK(refusal("\"roster\":[{\"respawn\":1,\"at\":1}]").find("r:1: roster") == 0);
  CHECK(refusal("\"roster\":[{\"leave\":1,\"at\":\"gate\"}]").find("r:1: roster") == 0);
}

TEST_CASE(
    "a game that stands still is recorded in a few lines, proven tick by tick, and played to any of them") {
  match::Match match(small_map("spline"), {60, 3});
  ReplayWriter writer;
  std::string text;
  writer.append_header(text, make_header(match, "tests", "small.json"));
  writer.append_keyframe(text, match.state());
  match.join({"ada", state::Role::kPlayer});
  for (int tick = 0; tick < 1500; ++tick) {
    writer.append_step(text, match.advance());
    if (match.tick() % 300 == 0) writer.append_keyframe(text, match.state());
  }
  REQUIRE(match.link().tick < 900);
  writer.append_end(text, "test over");
  CHECK(to_text(verdict(text)) == "ok ticks 0 to 1500\n");
  CHECK(static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n')) ==
        match.link().tick + 13);  // header, six keyframes, four stretches at rest, index, end
  const auto playback = opened(text)->play(1234);
  REQUIRE(playback);
  CHECK((*playback)->tick() == 1234);
  CHECK((*playback)->match().hash() == match.hash());
  // Steps that did something are not passed off as such that did not.
  std::string altered = text;
  const std::size_t moving = altered.find("{\"step\":100,");
  const std::size_t end = altered.find("{\"step\":103,");
  REQUIRE(end != std::string::npos);
  altered.replace(moving, end - moving,
                  "{\"step\":100,\"steps\":3," + altered.substr(altered.rfind("\"hash\"", end), 27));
  const Verification found = verdict(altered);
  REQUIRE(found.difference);
  CHECK(found.difference->tick == 101);
}

TEST_CASE("a pause stands where no tick passed, moves nothing, and is told") {
  match::Match match(small_map("spline"), {60, 3});
  ReplayWriter writer;
  std::string text;
  writer.append_header(text, make_header(match, "tests", "small.json"));
  writer.append_keyframe(text, match.state());
  for (int tick = 0; tick < 40; ++tick) {
    if (tick == 20) writer.append_pause(text, {match.tick(), 1000, 4600});
    if (tick == 30) writer.append_pause(text, {match.tick(), 9000, 8000});  // a clock that was set back
    writer.append_step(text, match.advance());
  }
  writer.append_end(text, "test over");
  CHECK(text.find("{\"pause\":20,\"from\":1000,\"until\":4600}\n{\"step\":20,\"steps\":10,") !=
        std::string::npos);
  CHECK(to_text(verdict(text)) == "ok ticks 0 to 40\n");
  const auto summary = inspect_summary(*opened(text));
  REQUIRE(summary);
  CHECK(summary->find("pauses   2, in which nobody was there, 3600 s in all\n") != std::string::npos);
  std::string misplaced = text;
  misplaced.replace(misplaced.find("{\"pause\":20"), 11, "{\"pause\":19");
  const auto refused = verify_text(misplaced);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().text().find("pause: of step 19 stands where step 20 is due") != std::string::npos);
}

TEST_CASE(
    "in a game that stands still, every tick is found, from either side, and as many steps by any scan") {
  for (const Encoding encoding : {Encoding::kPlain, Encoding::kZstd}) {
    const Rests rests = played_at_rest(encoding);
    for (const unsigned jobs : {1u, 4u}) CHECK(verdict_by(rests.bytes, jobs) == "ok ticks 0 to 800\n");
    const auto archive = opened(rests.bytes);
    const auto playback = archive->play(0);
    REQUIRE(playback);
    const auto check_at = [&](std::uint64_t tick) {
      REQUIRE((*playback)->seek(tick));
      // An input that waits is known from the keyframe on that it stands in, or once it was applied.
      const bool waits = tick > 520 && tick <= 575;
      const std::size_t size = waits ? rests.states[tick].find("\"next_player\"") : std::string::npos;
      const std::string found = state_text((*playback)->match().state());
      REQUIRE(found.substr(0, size) == rests.states[tick].substr(0, size));
    };
    for (std::uint64_t tick = 0; tick <= 800; ++tick) check_at(tick);
    for (std::uint64_t tick = 800; tick-- > 0;) check_at(tick);
    std::istringstream in(encoding == Encoding::kPlain ? rests.bytes
                                                       : played_at_rest(Encoding::kPlain).bytes);
    const auto scanned = scan_index(in, "r.jsonl");
    REQUIRE(scanned);
    CHECK(unlike_index(archive->index(), *scanned).empty());
    CHECK(scanned->last_tick == 800);
  }
}

TEST_CASE(
    "a recording that is cut off anywhere in a game that stands still is good up to there, by any jobs") {
  const std::string text = played_at_rest(Encoding::kPlain).bytes;
  const std::size_t begin = text.find('\n', text.find('\n') + 1) + 1;  // behind the first keyframe
  std::uint64_t ticks = 0;
  for (std::size_t size = begin; size < text.size(); size = text.find('\n', size) + 1) {
    if (text.compare(size, 7, "{\"end\":") == 0) break;
    for (const std::size_t cut : {size, size + 20}) {
      const std::string verdict = verdict_by(text.substr(0, cut), 1);
      CHECK(verdict_by(text.substr(0, cut), 4) == verdict);
      REQUIRE(verdict.find("ok ticks 0 to ") == 0);
      CHECK(verdict.find("then the recording is cut off") != std::string::npos);
      const std::uint64_t reached = std::stoull(verdict.substr(14));
      CHECK(reached >= ticks);
      CHECK(opened(text.substr(0, cut))->last_tick() == reached);
      ticks = reached;
    }
  }
  CHECK(ticks == 800);
}

TEST_CASE(
    "who shortens or lengthens a stretch in which nothing happened is found by the next step that did") {
  const std::string text = played_at_rest(Encoding::kPlain).bytes;
  // All ticks behind it told one later or earlier, as whoever alters a recording would.
  for (const int change : {-1, 1}) {
    std::string altered;
    std::istringstream in(text);
    std::uint64_t tick = 0;
    for (std::string line; std::getline(in, line);) {
      const bool is_step = line.compare(0, 8, "{\"step\":") == 0;
      if (!is_step && line.compare(0, 8, "{\"chat\":") != 0) {
        if (line.find("\"keyframe\":") == 1 && tick > 0) continue;  // the stretch is under 5000 steps
        if (line.find("\"index\":") != 1 && line.find("\"end\":") != 1) altered += line + "\n";
        continue;
      }
      if (!is_step) continue;
      const NumberPlace steps = find_number(line, "\"steps\":");
      std::uint64_t count = steps.begin == std::string::npos
                                ? 1
                                : std::stoull(line.substr(steps.begin, steps.end - steps.begin));
      if (tick == 0) {
        REQUIRE(count > 2);
        count = static_cast<std::uint64_t>(static_cast<int>(count) + change);
        line.replace(steps.begin, steps.end - steps.begin, std::to_string(count));
      }
      const NumberPlace number = find_number(line, "\"step\":");
      line.replace(number.begin, number.end - number.begin, std::to_string(tick));
      altered += line + "\n";
      tick += count;
    }
    const Verification found = verdict(altered);
    REQUIRE(found.difference);
    CHECK(found.difference->tick == static_cast<std::uint64_t>(131 + change));
  }
}

TEST_CASE("a line of many steps costs who only scans it no more than a line") {
  match::Match match(small_map("spline"), {60, 3});
  std::string text;
  append_header(text, make_header(match, "tests", "small.json"));
  append_keyframe(text, match.state());
  append_quiet_steps(text, 0, 5000, 0);
  std::istringstream in(text);
  ReplayReader reader(in, "r");
  REQUIRE(reader.read_header());
  REQUIRE(reader.next_line());
  const auto line = reader.next_line();
  REQUIRE((line && *line));
  CHECK(std::get<StepLine>(**line).steps == 5000);
  CHECK(std::get<StepLine>(**line).step.tick == 0);
  const auto end = reader.next_line();
  REQUIRE(end);
  CHECK_FALSE(end->has_value());
}

TEST_CASE("a line of many steps is no way past the keyframe that is due") {
  match::Match match(small_map("spline"), {60, 3});
  std::string text;
  append_header(text, make_header(match, "tests", "small.json"));
  append_keyframe(text, match.state());
  for (std::uint64_t first = 0; first < 10000; first += 5000) append_quiet_steps(text, first, 5000, 0);
  const auto verification = verify_text(text);
  REQUIRE_FALSE(verification);
  CHECK(verification.error().text().find("r.jsonl:4: more than 5000 steps after the last keyframe") == 0);
}

TEST_CASE("a line of many steps in which something moves is told at once, not re-run") {
  match::Match match(small_map("spline"), {60, 3});
  match.join({"ada", state::Role::kPlayer});
  match.file({1, 0, {state::ThrustKind::kMapVector, {1.0, 0.0}}, state::kHeld, 1});
  while (match.tick() < 60) match.advance();
  std::string text;
  append_header(text, make_header(match, "tests", "small.json"));
  append_keyframe(text, match.state());
  append_quiet_steps(text, 60, 5000, match.hash());
  const Verification found = verdict(text);
  REQUIRE(found.difference);
  CHECK(found.difference->tick == 61);
  CHECK(found.difference->detail.find("nothing moved then") != std::string::npos);
  CHECK(found.ticks == 1);
}

TEST_CASE("what was altered before a quiet stretch is told by the keyframe behind it") {
  match::Match match(small_map("spline"), {60, 3});
  std::string text;
  append_header(text, make_header(match, "tests", "small.json"));
  append_keyframe(text, match.state());
  match.join({"ada", state::Role::kPlayer});
  while (!match.stands_still()) {
    match::StepRecord step = match.advance();
    if (step.tick == 1) step.hash ^= 1;
    append_step(text, step, {});
  }
  append_quiet_steps(text, match.tick(), 100, match.hash());
  match.stand_still(100);
  append_keyframe(text, match.state());
  append_quiet_steps(text, match.tick(), 100, match.hash());
  const Verification found = verdict(text);
  REQUIRE(found.difference);
  CHECK(found.difference->tick == 2);
  CHECK(found.difference->detail.find("the same lice, so what was altered moved none") != std::string::npos);
}

}  // namespace woodlouse::replay
