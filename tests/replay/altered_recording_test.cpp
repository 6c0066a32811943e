// A recording with anything altered is caught, at the right tick and with the right louse.
#include <bit>
#include <catch2/catch.hpp>
#include <charconv>
#include <string>

#include "shared/core/joined.h"
#include "shared/core/random.h"
#include "shared/json/text.h"
#include "shared/state/louse_fields.h"
#include "tests/replay/recorded_match.h"

namespace woodlouse::replay {
namespace {

double to_double(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// Steps whose line has inputs.
std::vector<std::uint64_t> steps_with(const Recording& recording, const std::string& what) {
  std::vector<std::uint64_t> steps;
  std::uint64_t step = 0;
  for (const std::string& line : recording.lines) {
    if (line.compare(0, 8, "{\"step\":") != 0) continue;
    if (line.find(what) != std::string::npos) steps.push_back(step);
    ++step;
  }
  return steps;
}

/// Where the rows of a step's inputs begin and end (past the bracket).
std::vector<std::pair<std::size_t, std::size_t>> input_places(const std::string& line) {
  std::vector<std::pair<std::size_t, std::size_t>> places;
  std::size_t at = line.find("\"inputs\":[");
  if (at == std::string::npos) return places;
  int depth = 0;
  std::size_t begin = 0;
  for (at += 9; at == line.find("\"inputs\":[") + 9 || depth > 0; ++at) {
    if (line[at] == '[' && ++depth == 2) begin = at;
    if (line[at] == ']' && --depth == 1) places.emplace_back(begin, at + 1);
  }
  return places;
}

/// The first number of the thrust of a step's first input that pushes; nothing: none does.
NumberPlace thrust_place(const std::string& line) {
  for (const auto& [begin, end] : input_places(line)) {
    std::size_t at = line.find(',', line.find(',', begin) + 1) + 1;  // behind player and seq
    if (line[at] == 'n') continue;
    if (line[at] == '[') ++at;
    return {at, line.find_first_of(",]", at)};
  }
  return {};
}

/// Of an altered step: its hash is another, or, where the keyframe before knew the input already, its inputs
/// are.
bool is_caught_in(std::uint64_t step, const Difference& difference) {
  return difference.what.find("hash ") == 0
             ? difference.tick == step + 1
             : difference.what.find("inputs of step ") == 0 && difference.tick == step;
}

std::string altered_thrust(const std::string& number) {
  const double value = to_double(number);
  return number.find('.') == std::string::npos && value > 0 ? std::to_string(static_cast<int>(value) - 1)
         : number.find('.') == std::string::npos            ? std::to_string(static_cast<int>(value) + 1)
                                                            : "1";
}

}  // namespace

TEST_CASE("an input whose thrust differs by 1/128 is caught in its own step") {
  const Recording recording = record({.seed = 3, .steps = 150});
  for (const std::uint64_t step : steps_with(recording, "\"inputs\":")) {
    Recording altered = recording;
    std::string& line = altered.lines[altered.line_of_step(step)];
    const NumberPlace place = thrust_place(line);
    REQUIRE(place.begin != std::string::npos);
    const std::string number = line.substr(place.begin, place.end - place.begin);
    line.replace(place.begin, place.end - place.begin, altered_thrust(number));
    const Verification verification = verdict(altered.text());
    REQUIRE(verification.difference);
    CHECK(is_caught_in(step, *verification.difference));
  }
}

TEST_CASE("a zero thrust that lost its sign is caught") {
  const Recording recording = record({.seed = 8, .steps = 600});
  std::size_t caught = 0;
  for (const char* ending : {",", "]"}) {
    const std::string zero = std::string("-0.0") + ending;
    for (const std::uint64_t step : steps_with(recording, zero)) {
      Recording altered = recording;
      std::string& line = altered.lines[altered.line_of_step(step)];
      line.replace(line.find(zero), 4, "0");
      const Verification verification = verdict(altered.text());
      REQUIRE(verification.difference);
      CHECK(is_caught_in(step, *verification.difference));
      ++caught;
    }
  }
  CHECK(caught > 0);
}

TEST_CASE("an input that is left out, or stands in a neighbouring step, is caught at the first of the two") {
  const Recording recording = record({.seed = 4, .steps = 150});
  for (const std::uint64_t step : steps_with(recording, "\"inputs\":[")) {
    const std::string& line = recording.lines[recording.line_of_step(step)];
    const auto places = input_places(line);
    if (places.size() != 1 || step == 149) continue;
    const std::string input = line.substr(places[0].first, places[0].second - places[0].first);
    const std::size_t begin = line.find(",\"inputs\":[");
    Recording altered = recording;
    altered.lines[altered.line_of_step(step)].erase(begin, places[0].second + 1 - begin);
    REQUIRE(verdict(altered.text()).difference);
    CHECK(is_caught_in(step, *verdict(altered.text()).difference));

    std::string& next = altered.lines[altered.line_of_step(step + 1)];
    if (next.find("\"inputs\"") != std::string::npos) continue;
    next.insert(next.find(",\"hash\""), ",\"inputs\":[" + input + "]");
    const Verification verification = verdict(altered.text());
    REQUIRE(verification.difference);
    CHECK(is_caught_in(step, *verification.difference));
  }
}

TEST_CASE("inputs recorded in another order than they are applied are named") {
  const Recording recording = record({.seed = 5, .steps = 200});
  std::size_t swapped = 0;
  for (const std::uint64_t step : steps_with(recording, "\"inputs\":[")) {
    Recording altered = recording;
    std::string& line = altered.lines[altered.line_of_step(step)];
    const auto places = input_places(line);
    if (places.size() < 2) continue;
    const std::string first = line.substr(places[0].first, places[0].second - places[0].first);
    const std::string second = line.substr(places[1].first, places[1].second - places[1].first);
    line.replace(places[0].first, places[1].second - places[0].first, second + "," + first);
    const Verification verification = verdict(altered.text());
    REQUIRE(verification.difference);
    CHECK(verification.difference->tick == step);
    CHECK(verification.difference->what.find("inputs of step " + std::to_string(step) + ": player ") == 0);
    ++swapped;
  }
  CHECK(swapped > 3);
}

TEST_CASE("an input of a player without a louse is named, one with a seq used before shows in the hash") {
  const Recording recording = record({.seed = 6, .steps = 200});
  const auto with_input = [&](std::uint64_t first_step, const std::string& input) {
    Recording altered = recording;
    for (std::uint64_t step = first_step;; ++step) {
      std::string& line = altered.lines[altered.line_of_step(step)];
      if (line.find("\"inputs\"") != std::string::npos) continue;
      line.insert(line.find(",\"hash\""), ",\"inputs\":[" + input + "]");
      const Verification verification = verdict(altered.text());
      REQUIRE(verification.difference);
      return std::pair(verification.difference->tick - step, verification.difference->what);
    }
  };
  CHECK(with_input(100, "[999,1,64]") ==
        std::pair(std::uint64_t{0},
                  std::string("the input of player 999 seq 1 can't be applied: the player has no louse")));
  const auto [ticks, what] = with_input(100, "[1,1,64]");
  CHECK(((ticks == 1 && what.find("hash ") == 0) || what.find("can't be applied") != std::string::npos));
}

TEST_CASE("two inputs of a step with the same player and seq are named") {
  const Recording recording = record({.seed = 6, .steps = 100});
  const std::uint64_t step = steps_with(recording, "\"inputs\":[").front();
  Recording altered = recording;
  std::string& line = altered.lines[altered.line_of_step(step)];
  const auto [begin, end] = input_places(line).front();
  line.insert(end, "," + line.substr(begin, end - begin));
  const Verification verification = verdict(altered.text());
  REQUIRE(verification.difference);
  CHECK(verification.difference->tick == step);
  CHECK(verification.difference->what.find("inputs of step ") == 0);
}

TEST_CASE("a join, leave or respawn that is left out or altered is caught in its own step") {
  const Recording recording = record({.seed = 7, .steps = 400, .notes = Notes::kNone});
  for (const char* kind : {"join", "leave", "respawn"}) {
    for (const char* other : {"leave", "respawn", ""}) {
      if (std::string(kind) == other) continue;
      const auto steps = steps_with(recording, std::string("[{\"") + kind + "\"");
      REQUIRE_FALSE(steps.empty());
      for (const std::uint64_t step : steps) {
        Recording altered = recording;
        std::string& line = altered.lines[altered.line_of_step(step)];
        const std::size_t begin = line.find(",\"roster\":[");
        if (*other == '\0') {
          line.erase(begin, line.find(']', begin) + 1 - begin);
        } else {
          line.replace(line.find(kind), std::string(kind).size(), other);
          constexpr std::string_view kLabel = R"(,"name":"","role":"bot")";
          const std::size_t label = line.find(kLabel, begin);
          if (std::string(kind) == "join") line.erase(label, kLabel.size());
        }
        const auto verification = verify_text(altered.text());
        REQUIRE(verification);
        REQUIRE(verification->difference);
        CHECK((verification->difference->tick == step || verification->difference->tick == step + 1));
      }
    }
  }
}

TEST_CASE("one altered digit of any hash is caught at its tick") {
  const Recording recording = record({.seed = 9, .steps = 150});
  for (std::uint64_t step = 0; step < 150; ++step) {
    Recording altered = recording;
    std::string& line = altered.lines[altered.line_of_step(step)];
    char& digit = line[line.find("\"hash\":\"") + 8 + step % 16];
    digit = digit == 'a' ? 'b' : 'a';
    const Verification verification = verdict(altered.text());
    REQUIRE(verification.difference);
    CHECK(verification.difference->tick == step + 1);
    const bool has_keyframe = step + 1 <= 120;
    CHECK((verification.difference->detail.find("the same lice") != std::string::npos) == has_keyframe);
    CHECK((verification.difference->detail == "no keyframe follows that could say which louse") ==
          !has_keyframe);
  }
}

TEST_CASE("one altered number of a keyframe is caught and louse, field and both values are named") {
  const Recording recording = record({.seed = 10, .steps = 120});
  const std::size_t at = recording.line_of_step(119) + 1;
  const std::string& line = recording.lines[at];
  REQUIRE(line.find("{\"keyframe\":120,") == 0);
  std::vector<std::string> names;
  for (const state::LouseField& field : state::kLouseFields) names.emplace_back(field.name);
  std::size_t checked = 0;
  std::size_t begin = line.find("\"lice\":[[") + 9;
  for (std::size_t field = 0; begin < line.size() && line[begin] != ']'; ++field) {
    const std::size_t end = line.find_first_of(",]", begin);
    const std::string number = line.substr(begin, end - begin);
    if (field % names.size() != 0) {  // an id's change is another louse, below
      const bool is_real = names[field % names.size()].find_first_of("xyd") != std::string::npos &&
                           names[field % names.size()] != "ticks_left" &&
                           names[field % names.size()] != "thrust_kind";
      // One unit in the last place for the reals, another whole number otherwise.
      const std::string other =
          is_real
              ? json::double_text(std::bit_cast<double>(std::bit_cast<std::uint64_t>(to_double(number)) ^ 1u))
              : (number == "1" ? "2" : "1");
      Recording altered = recording;
      altered.lines[at].replace(begin, end - begin, other);
      const Verification verification = verdict(altered.text());
      INFO(names[field % names.size()]);
      REQUIRE(verification.difference);
      CHECK(verification.difference->tick == 120);
      const std::string wanted =
          ", " + names[field % names.size()] + ": " + other + " recorded, " + number + " re-run";
      INFO(verification.difference->detail);
      CHECK(verification.difference->detail.find("keyframe 120: louse ") == 0);
      CHECK(verification.difference->detail.find(wanted) != std::string::npos);
      ++checked;
    }
    begin = end + 1;
    if (line[end] == ']') begin = line[end + 1] == ',' ? end + 3 : line.size();
  }
  CHECK(checked >= 36);

  Recording without = recording;  // the first louse's row
  std::string& shorter = without.lines[at];
  const std::size_t first = shorter.find("\"lice\":[[") + 8;
  const NumberPlace id = find_number(shorter, "\"lice\":");
  const std::string name = shorter.substr(id.begin, id.end - id.begin);
  shorter.erase(first, shorter.find("],[", first) + 2 - first);
  REQUIRE(verdict(without.text()).difference);
  CHECK(verdict(without.text()).difference->detail ==
        "keyframe 120: louse " + name + " is only in the re-run");
}

TEST_CASE("an altered input shows in the next keyframe as its louse, a field and both values") {
  const Recording recording = record({.seed = 3, .steps = 181});
  std::size_t named = 0;
  const auto steps = steps_with(recording, "\"inputs\":[");
  for (const std::uint64_t step : steps) {
    Recording altered = recording;
    std::string& line = altered.lines[altered.line_of_step(step)];
    const NumberPlace place = thrust_place(line);
    const std::size_t row = line.rfind('[', place.begin - 2);
    const std::string player = line.substr(row + 1, line.find(',', row) - row - 1);
    const double value = to_double(line.substr(place.begin, place.end - place.begin));
    line.replace(place.begin, place.end - place.begin, value > 0 ? "-32" : "32");
    const auto verification = verdict(altered.text());
    REQUIRE(verification.difference);
    CHECK(is_caught_in(step, *verification.difference));
    const std::string& detail = verification.difference->detail;
    // No other louse moves otherwise. Its own may not either, when a respawn, a leave or its next input came.
    if (detail.find(": louse ") != std::string::npos) {
      CHECK(detail.find(core::joined({": louse ", player, ", "})) != std::string::npos);
      ++named;
    }
  }
  CHECK(named > steps.size() / 2);
}

TEST_CASE("no altered byte of a step or keyframe passes unnoticed or does harm") {
  const Recording recording = record({.seed = 12, .steps = 125, .notes = Notes::kNone});
  core::Random random(13);
  std::size_t errors = 0;
  std::size_t differences = 0;
  for (int round = 0; round < 1000; ++round) {
    Recording altered = recording;
    const std::size_t k = 1 + random.next() % (altered.lines.size() - 2);
    std::string& line = altered.lines[k];
    const std::size_t at = random.next() % line.size();
    const char before = line[at];
    line[at] = static_cast<char>(random.next() & 0xff);
    if (line[at] == before) continue;
    const auto verification = verify_text(altered.text());
    if (!verification) {
      ++errors;
      CHECK(verification.error().where.find("r.jsonl:") == 0);
      continue;
    }
    if (verification->difference) {
      ++differences;
      continue;
    }
    // The 17th digit of a number may change without changing the double; an exponent's e may grow.
    const bool is_digit = before >= '0' && before <= '9' && line[at] >= '0' && line[at] <= '9';
    const bool is_exponent = before == 'e' && line[at] == 'E';
    // Margins, and what the index says, are for people; so is the case of an exponent.
    const bool is_for_people = line.find("{\"index\"") == 0 || line.find("{\"end\"") == 0;
    INFO(line << "at " << at << " was " << before);
    CHECK((is_for_people || (line.find("keyframe") != std::string::npos && (is_digit || is_exponent))));
  }
  CHECK(errors > 100);
  CHECK(differences > 5);
}

}  // namespace woodlouse::replay
