#include "shared/replay/writer.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include "shared/core/random.h"
#include "shared/state/louse_fields.h"
#include "tests/replay/recorded_match.h"

namespace woodlouse::replay {
namespace {

Line read_one(const std::string& text) {
  std::istringstream in(text);
  ReplayReader reader(in, "r");
  const auto line = reader.next();
  if (!line) FAIL(line.error().text());
  REQUIRE(line->has_value());
  return **line;
}

std::string error_of(const std::string& text) {
  std::istringstream in(text);
  ReplayReader reader(in, "r");
  const auto line = reader.next();
  return line ? std::string("no error") : line.error().text();
}

std::string header_error(const std::string& text) {
  std::istringstream in(text);
  ReplayReader reader(in, "r");
  const auto header = reader.read_header();
  return header ? std::string("no error") : header.error().text();
}

double any_double(core::Random& random) {
  for (;;) {
    const auto value = std::bit_cast<double>(random.next());
    if (std::isfinite(value) && std::abs(value) < 1e300) return random.next() % 8 == 0 ? -0.0 : value;
  }
}

const std::string kHash = ",\"hash\":\"0123456789abcdef\"}\n";

}  // namespace

TEST_CASE("a header reads back as it was written") {
  const auto map = small_map("spline");
  match::Match match(map, {30, std::numeric_limits<std::uint64_t>::max()});
  Header header = make_header(match, "woodlouse 0.1 \"test\"", "maps/small.json");
  header.parent = Parent{"game \"1\".ndjson", 2502, 0x0123456789abcdef};
  std::string out;
  ReplayWriter().append_header(out, header);
  CHECK(out.find('\n') == out.size() - 1);
  std::istringstream in(out);
  const auto read = ReplayReader(in, "r").read_header();
  REQUIRE(read);
  CHECK(read->behavior == match::kBehavior);
  CHECK(read->build == header.build);
  CHECK(read->seed == header.seed);
  CHECK(read->tick_hz == 30);
  CHECK(read->map_name == "small");
  CHECK(read->map_hash == map->hash);
  CHECK(read->map_definition == map->canonical);
  CHECK(read->parent == header.parent);
}

TEST_CASE("random steps read back as they were written, minus zero and 64-bit hashes included") {
  core::Random random(5);
  for (int round = 0; round < 500; ++round) {
    match::StepRecord step;
    step.tick = random.next() >> (11 + random.next() % 50);
    step.hash = random.next();
    ReplayWriter writer;
    const auto player = [&] { return static_cast<match::PlayerId>(1 + random.next() % 0xfffffffe); };
    for (std::uint64_t n = random.next() % 4; n > 0; --n) {
      step.roster.push_back({static_cast<match::RosterAction>(1 + random.next() % 3), player()});
      if (step.roster.back().action == match::RosterAction::kJoin)
        step.roster.back().label = {"n\xc3\xa4me\n\"",
                                    random.next() % 2 == 0 ? state::Role::kPlayer : state::Role::kBot};
    }
    for (std::uint64_t n = random.next() % 4; n > 0; --n) {
      match::AppliedInput input;
      input.tick = step.tick;
      input.player = player();
      input.seq = static_cast<std::uint32_t>(random.next());
      input.kind = static_cast<state::ThrustKind>(random.next() % 3);
      const auto value = [&] {
        const double any = random.uniform() * 1.4 - 0.7;
        const double quanta = std::trunc(any * 128.0) / 128.0;
        const double choices[] = {-0.0, any, quanta,
                                  std::bit_cast<double>(std::bit_cast<std::uint64_t>(quanta) ^ 1u)};
        return choices[random.next() % 4];
      };
      if (input.kind != state::ThrustKind::kNone) input.thrust.x = value();
      if (input.kind == state::ThrustKind::kMapVector) input.thrust.y = value();
      input.ticks =
          random.next() % 2 ? state::kHeld : static_cast<std::uint32_t>(random.next() % state::kHeld);
      step.inputs.push_back(input);
      if (random.next() % 2) writer.note_margin(input.player, input.seq, -5);
    }
    std::string out;
    writer.append_step(out, step);
    INFO(out);
    const StepLine line = std::get<StepLine>(read_one(out));
    CHECK(line.step.tick == step.tick);
    CHECK(line.step.hash == step.hash);
    CHECK(line.step.roster == step.roster);
    REQUIRE(line.step.inputs.size() == step.inputs.size());
    for (std::size_t k = 0; k < step.inputs.size(); ++k) {
      CHECK(std::memcmp(&line.step.inputs[k], &step.inputs[k], sizeof step.inputs[k]) == 0);
    }
  }
}

TEST_CASE("random keyframes read back bit for bit") {
  core::Random random(6);
  for (int round = 0; round < 200; ++round) {
    match::MatchState state;
    state.tick = random.next() >> 12;
    state.hash = random.next();
    state.link = {random.next(), random.next(),       random.next(),
                  random.next(), random.next() >> 12, random.next()};
    state.lice.resize(random.next() % 6);
    state::LouseId id = 0;
    ReplayWriter writer;
    for (state::Louse& louse : state.lice) {
      for (const state::LouseField& field : state::kLouseFields) {
        const double value =
            state::holds_integer(field) ? static_cast<double>(random.next() % 3) : any_double(random);
        state::set_field(louse, field, value);
      }
      louse.id = id += 1 + static_cast<state::LouseId>(random.next() % 1000000);
      louse.thrust_ticks = static_cast<std::uint32_t>(random.next());
      const bool has_seq = random.next() % 4 != 0;
      state.players.push_back(
          {id, has_seq ? std::optional(static_cast<std::uint32_t>(random.next())) : std::nullopt});
      state.labels[id] = {random.next() % 2 == 0 ? "an\"na" : "", state::Role::kBot};
      if (random.next() % 2 == 0) {
        const double push = static_cast<double>(random.next() % 129) / 256.0;
        state.waiting.push_back({id,
                                 7,
                                 {push, -0.0},
                                 state::ThrustKind::kMapVector,
                                 random.next() % 2 == 0 ? state::kHeld : 12,
                                 state.tick + 1});
      }
    }
    state.next_player = id + 1;
    std::string out;
    writer.append_keyframe(out, state);
    const Keyframe keyframe = std::get<Keyframe>(read_one(out));
    CHECK(state_text(keyframe.state) == state_text(state));
    REQUIRE(keyframe.state.lice.size() == state.lice.size());
    for (std::size_t k = 0; k < state.lice.size(); ++k) {
      CHECK(std::memcmp(&keyframe.state.lice[k], &state.lice[k], sizeof state.lice[k]) == 0);
    }
    CHECK(keyframe.state.players == state.players);
    REQUIRE(keyframe.state.waiting.size() == state.waiting.size());
    for (std::size_t k = 0; k < state.waiting.size(); ++k) {
      CHECK(std::memcmp(&keyframe.state.waiting[k], &state.waiting[k], sizeof state.waiting[k]) == 0);
    }
    CHECK(keyframe.state.labels == state.labels);
    CHECK(keyframe.state.link == state.link);
  }
}

TEST_CASE("a margin is kept in whole milliseconds, down, so that what came late stays late") {
  const std::pair<std::int64_t, std::int64_t> margins[] = {
      {0, 0}, {999, 0}, {1000, 1}, {15999, 15}, {-1, -1}, {-1000, -1}, {-1001, -2}, {-250000, -250}};
  for (const auto& [us, ms] : margins) {
    ReplayWriter writer;
    match::StepRecord step;
    step.inputs = {{3, 9, {}, state::ThrustKind::kNone, state::kHeld, 0}};
    writer.note_margin(3, 9, us);
    std::string out;
    writer.append_step(out, step);
    CHECK(std::get<StepLine>(read_one(out)).margins_ms.front() == ms);
  }
}

TEST_CASE("chat and end lines read back, whatever the text holds") {
  std::string out;
  ReplayWriter writer;
  writer.append_chat(out, 77, 3, "a\"b", "line\nbreak \\ \xff end");
  CHECK(out.find('\n') == out.size() - 1);
  const ChatLine chat = std::get<ChatLine>(read_one(out));
  CHECK(chat.tick == 77);
  CHECK(chat.player == 3);
  CHECK(chat.name == "a\"b");
  CHECK(chat.text == "line\nbreak \\ \xef\xbf\xbd end");
  const std::size_t chat_bytes = out.size();
  out.clear();
  writer.append_end(out, "SIGTERM");
  std::istringstream in(out);
  ReplayReader reader(in, "r");
  const auto index = reader.next();
  REQUIRE((index && index->has_value()));
  CHECK(std::holds_alternative<IndexLine>(**index));
  const auto end = reader.next();
  REQUIRE((end && end->has_value()));
  CHECK(std::get<End>(**end).reason == "SIGTERM");
  CHECK(std::get<End>(**end).index_offset == chat_bytes);
}

TEST_CASE("a keyframe's columns are the wire's `all`") {
  std::vector<std::string> names;
  for (const state::LouseField& field : state::kLouseFields) names.emplace_back(field.name);
  std::vector<std::string> wire;
  for (const protocol::Column column : protocol::all_columns()) wire.emplace_back(protocol::to_text(column));
  CHECK(names == wire);
}

TEST_CASE("notes of what is never applied are forgotten with their player") {
  ReplayWriter writer;
  writer.note_margin(1, 9, 1234);
  match::StepRecord step;
  step.roster = {{match::RosterAction::kJoin, 1, {"one"}}, {match::RosterAction::kLeave, 1}};
  std::string out;
  writer.append_step(out, step);
  step.tick = 1;
  step.roster.clear();
  step.inputs = {{1, 9, {}, state::ThrustKind::kNone, state::kHeld, 1}};
  out.clear();
  writer.append_step(out, step);
  CHECK(out.find("\"inputs\":[[1,9,null]]") != std::string::npos);
}

TEST_CASE("every field of a step is checked, with line and field") {
  CHECK(error_of("{\"step\":-1" + kHash).find("r:1: step: a whole number is wanted") == 0);
  CHECK(error_of("{\"step\":1.5" + kHash).find("r:1: step: a whole number is wanted") == 0);
  CHECK(error_of("{\"step\":1}\n") == "r:1: \"hash\" is missing");
  CHECK(
      error_of("{\"step\":1,\"hash\":\"0123456789ABCDEF\"}\n").find("r:1: hash: 16 lower-case hex digits") ==
      0);
  CHECK(error_of("{\"step\":1,\"hash\":\"123\"}\n").find("r:1: hash: 16 lower-case hex digits") == 0);
  CHECK(error_of("{\"step\":1,\"hash\":7}\n").find("r:1: hash: 16 lower-case hex digits") == 0);
  CHECK(error_of("{\"step\":1,\"inputz\":[]" + kHash) ==
        "r:1: inputz: is not known (did you mean \"inputs\"?)");
  CHECK(error_of("{\"step\":1,\"step\":1" + kHash) == "r:1: step: stands twice (keep one of them)");
  CHECK(error_of("{\"step\":1,\"roster\":{}" + kHash) == "r:1: roster: a list is wanted");
  CHECK(error_of("{\"step\":1,\"roster\":[{\"fly\":1}]" + kHash).find("r:1: roster[0]: {\"join\": id}") == 0);
  CHECK(error_of("{\"step\":1,\"roster\":[{\"join\":0}]" + kHash)
            .find("r:1: roster[0].join: 0 is out of range") == 0);
  CHECK(error_of("{\"step\":1,\"roster\":[{\"join\":1,\"leave\":1}]" + kHash)
            .find("r:1: roster[0].leave: is not known") == 0);
  CHECK(error_of("{\"step\":1,\"roster\":[{\"join\":1,\"name\":\"a\",\"role\":\"king\"}]" + kHash)
            .find("r:1: roster[0].role: is no role") == 0);
  const auto input_error = [](const std::string& input) {
    return error_of("{\"step\":1,\"inputs\":[" + input + "]" + kHash);
  };
  CHECK(input_error("[1,1,64]") == "no error");
  CHECK(input_error("[1,1,null,null,9]") == "no error");
  CHECK(input_error("[1,1]") == "r:1: inputs[0]: [player, seq, thrust, margin in ms, ticks] is wanted");
  CHECK(input_error("[1,1,1,1,1,1]") ==
        "r:1: inputs[0]: [player, seq, thrust, margin in ms, ticks] is wanted");
  CHECK(input_error("{\"player\":1}") ==
        "r:1: inputs[0]: [player, seq, thrust, margin in ms, ticks] is wanted");
  CHECK(input_error("[0,1,64]").find("r:1: inputs[0][0]: 0 is out of range") == 0);
  CHECK(input_error("[1,-1,64]").find("r:1: inputs[0][1]: a whole number") == 0);
  CHECK(input_error("[1,1,129]").find("r:1: inputs[0][2]: 129 / 128 is out of range") == 0);
  CHECK(input_error("[1,1,1.5]").find("r:1: inputs[0][2]: 1.5 is out of range") == 0);
  CHECK(input_error("[1,1,[115,115]]") == "r:1: inputs[0][2]: is longer than 1");
  CHECK(input_error("[1,1,[115]]").find("r:1: inputs[0][2]: a pair") == 0);
  CHECK(input_error("[1,1,true]").find("r:1: inputs[0][2]: a number is wanted") == 0);
  CHECK(input_error("[1,1,0,0.5]").find("r:1: inputs[0][3]: a whole number") == 0);
  CHECK(input_error("[1,1,0,1,4294967295]").find("r:1: inputs[0][4]: 4294967295 is out of range") == 0);
}

TEST_CASE("every field of a keyframe, a chat and an end is checked") {
  const std::string columns =
      "\"columns\":[\"id\",\"phase\",\"x\",\"y\",\"vx\",\"vy\",\"heading_x\",\"heading_y\",\"tx\",\"ty\","
      "\"flight_z\",\"flight_vz\",\"distance\","
      "\"thrust_kind\",\"ticks_left\"],";
  const std::string zeros = "\"0000000000000000\"";
  const std::string state = "\"hash\":" + zeros + ",\"previous\":" + zeros + ",\"inputs\":" + zeros +
                            ",\"roster\":" + zeros + ",\"rules\":" + zeros +
                            ",\"link\":60,\"generator\":" + zeros +
                            ",\"next_player\":3,\"players\":[],\"waiting\":[],";
  const auto keyframe_error = [&](const std::string& lice) {
    return error_of("{\"keyframe\":60," + state + columns + "\"lice\":[" + lice + "]}\n");
  };
  CHECK(keyframe_error("[1,0,0,0,0,0,1,0,0,0,0,0,0,0,0]") == "no error");
  CHECK(keyframe_error("[1,0,0,0,0,0,1,0,0,0,0,0,0,0]").find("r:1: lice[0]: a row of 15") == 0);
  CHECK(keyframe_error("[1,0,0,0,0,0,1,0,0,0,0,0,0,3,0]").find("r:1: lice[0][13]: 3 is out of range") == 0);
  CHECK(keyframe_error("[1,0,null,0,0,0,1,0,0,0,0,0,0,0,0]").find("r:1: lice[0][2]: a number is wanted") ==
        0);
  CHECK(error_of("{\"keyframe\":60," + state + "\"columns\":[\"id\"],\"lice\":[]}\n")
            .find("r:1: columns: are not the columns") == 0);
  CHECK(error_of("{\"keyframe\":60," + state + "\"lice\":[]}\n") == "r:1: \"columns\" is missing");
  CHECK(error_of("{\"keyframe\":60," + columns + "\"lice\":[]}\n") == "r:1: \"hash\" is missing");
  CHECK(error_of("{\"chat\":1,\"player\":1,\"name\":\"a\"}\n") == "r:1: \"text\" is missing");
  CHECK(error_of("{\"chat\":1,\"player\":1,\"name\":\"a\",\"text\":\"" + std::string(5000, 'x') + "\"}\n")
            .find("r:1: text: text of at most") == 0);
  CHECK(error_of("{\"end\":\"1\",\"reason\":\"\"}\n").find("r:1: end: a whole number") == 0);
  CHECK(error_of("{\"hello\":1}\n") == "r:1: is no step, keyframe, chat, pause, index or end");
  CHECK(error_of("[]\n") == "r:1: is no step, keyframe, chat, pause, index or end");
  CHECK(error_of("\n").find("r:1: not JSON") == 0);
}

TEST_CASE("another format, version or behavior is refused and both are named") {
  const Recording recording = record({.steps = 1});
  const std::string header = recording.lines.front();
  REQUIRE(header_error(header) == "no error");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = header;
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return header_error(text.replace(at, from.size(), to));
  };
  CHECK(with("woodlouse-replay", "doom-demo").find("r:1: is no recording") == 0);
  CHECK(with("\"version\":3", "\"version\":2") ==
        "r:1: version: recorded with version 2, this program has version 3 (take a program of that one)");
  const std::string behavior = "\"behavior\":" + std::to_string(match::kBehavior);
  CHECK(with(behavior, "\"behavior\":99") ==
        "r:1: behavior: recorded with behavior 99, this program has behavior " +
            std::to_string(match::kBehavior) + " (take a program of that one)");
  CHECK(with("\"behavior\":", "\"behaviour\":") == "r:1: \"behavior\" is missing");
  CHECK(with("\"seed\":\"1\"", "\"seed\":1").find("r:1: seed: a whole number of 64 bits as text") == 0);
  CHECK(with("\"tick_hz\":60", "\"tick_hz\":0").find("r:1: tick_hz: 0 is out of range") == 0);
  CHECK(with("\"definition\":", "\"file\":\"x\",\"definition\":")
            .find("r:1: map: either a definition or a file") == 0);
  CHECK(header_error("") == "r: is empty");
  CHECK(header_error(header.substr(0, header.size() - 1)) ==
        "r: has no whole line: it was cut off in the header");
  const std::string picture = GENERATE("#!/bin/sh\n", "\x89PNG\r\n\x1a\n", "\n");
  CHECK(
      header_error(picture) ==
      "r:1: not JSON, and so no recording (one is .ndjson or .ndjson.zst, as a server's --record writes it)");
  CHECK(header_error("{\"format\":\n").find("r:1: not JSON: ") == 0);
}

TEST_CASE("a line past the bound is an error, not memory") {
  std::string endless(kMaxReplayLineBytes + 1, ' ');
  CHECK(error_of(endless) == "r:1: a line longer than 32 MiB");
}

}  // namespace woodlouse::replay
