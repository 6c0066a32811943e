#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "shared/core/joined.h"
#include "shared/map/map_file.h"
#include "shared/replay/inspect.h"
#include "shared/replay/parallel_verify.h"
#include "shared/replay/source_file.h"
#include "shared/replay/writer.h"
#include "tests/replay/recorded_match.h"

namespace woodlouse::replay {
namespace {

/// How many whole step lines the first `length` bytes hold.
std::uint64_t whole_steps(const Recording& recording, std::size_t length) {
  std::uint64_t steps = 0;
  std::size_t end = 0;
  for (const std::string& line : recording.lines) {
    end += line.size();
    if (end <= length && line.compare(0, 8, "{\"step\":") == 0) ++steps;
  }
  return steps;
}

}  // namespace

TEST_CASE("a recorded match verifies, on every kind of surface, whoever came, went and overtook") {
  for (const char* surface : {"spline", "natural_spline", "function"}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      INFO(surface << " " << seed);
      const Recording recording = record({.seed = seed, .surface = surface});
      // The game is not a dull one.
      CHECK(recording.inputs > 50);
      CHECK(recording.overtaken > 5);
      CHECK(recording.leaves > 0);
      CHECK(recording.respawns > 0);
      const Verification verification = verdict(recording.text());
      CHECK(to_text(verification) == "ok ticks 0 to 400\n");
      CHECK(verification.ticks == 400);
      CHECK_FALSE(verification.cut_off);
    }
  }
}

TEST_CASE("a match of no steps verifies") {
  CHECK(to_text(verdict(record({.steps = 0}).text())) == "ok ticks 0 to 0\n");
}

TEST_CASE("a start that a game does not begin with is taken on trust, and said to be") {
  const Recording recording = record({.steps = 130});
  const std::size_t keyframe = recording.line_of_step(59) + 1;
  Recording late = recording;  // the first sixty steps and the keyframe before them cut away
  late.lines.erase(late.lines.begin() + 1, late.lines.begin() + static_cast<std::ptrdiff_t>(keyframe));
  CHECK(to_text(verdict(late.text())) ==
        "differs at tick 130: the index is not that of the lines before it: row 1 of its keyframes\n"
        "every tick up to it is the same\n");
  for (const unsigned jobs : {1u, 3u}) {
    const auto found = verify(ReplaySource::of_bytes(late.text_with_own_index(), "r.jsonl"), jobs);
    REQUIRE(found);
    CHECK_FALSE(found->from_start());
    CHECK(to_text(*found) == "ok ticks 60 to 130, the start is taken on trust\n");
  }
  late.lines.resize(2);
  CHECK(
      to_text(verdict(late.text())) ==
      "ok ticks 60 to 60, the start is taken on trust, then the recording is cut off: it has no end line\n");
  // Tick 0 is no way around it: a game of that seed begins with nobody there.
  Recording other = recording;
  std::string& header = other.lines.front();
  header.replace(header.find("\"seed\":\"1\""), 10, "\"seed\":\"2\"");
  CHECK(verify_text(other.text()).error().text().find("and the generator is the seed") != std::string::npos);
  CHECK(verdict(recording.text()).from_start());
}

TEST_CASE("a game begins with nobody there, nobody's input waiting and every id free, from a start or not") {
  const Recording recording = record({.steps = 130});
  const auto said = [&](const std::string& from, const std::string& to, unsigned jobs) {
    Recording altered = recording;
    std::string& keyframe = altered.lines[1];
    const std::size_t at = keyframe.find(from);
    REQUIRE(at != std::string::npos);
    keyframe.replace(at, from.size(), to);
    const auto found = verify(ReplaySource::of_bytes(altered.text_with_own_index(), "r.jsonl"), jobs);
    CHECK_FALSE(ReplayArchive::open(ReplaySource::of_bytes(altered.text(), "r.jsonl")).value()->play(3));
    return found ? to_text(*found) : found.error().text();
  };
  const std::string place = "r.jsonl:2: keyframe 0: ";
  const std::string hint = " (no game begins so: it was altered)";
  for (const unsigned jobs : {1u, 3u}) {
    CHECK(said("\"next_player\":1,", "\"next_player\":3,", jobs) ==
          place + "next_player: 3 recorded, 1 re-run" + hint);
    CHECK(said("\"next_player\":1,\"players\":[]", "\"next_player\":3,\"players\":[[2,7,\"a\",\"bot\"]]",
               jobs) == place + "next_player: 3 recorded, 1 re-run" + hint);
    CHECK(said("\"next_player\":1,\"players\":[],\"waiting\":[]",
               "\"next_player\":3,\"players\":[[2,7,\"a\",\"bot\"]],\"waiting\":[[9,2,7,64]]",
               jobs) == place + "waiting: 1 recorded, 0 re-run" + hint);
  }
}

TEST_CASE("an index that says what the lines do not is told, with one job and with several") {
  const Recording recording = record({.seed = 6, .steps = 130});
  const std::size_t index = recording.lines.size() - 2;
  REQUIRE(recording.leaves > 0);
  const auto said = [&](const std::string& key, std::size_t line) {
    Recording altered = recording;
    const NumberPlace number = find_number(altered.lines[line], key);
    REQUIRE(number.begin != std::string::npos);
    char& digit = altered.lines[line][number.end - 1];
    digit = digit == '9' ? '8' : static_cast<char>(digit + 1);
    std::string first;
    for (const unsigned jobs : {1u, 3u}) {
      const auto found = verify(ReplaySource::of_bytes(altered.text(), "r.jsonl"), jobs);
      REQUIRE(found);
      CHECK_FALSE(found->ok());
      const std::string text = to_text(*found);
      if (jobs == 1) first = text;
      CHECK(text == first);
    }
    return first;
  };
  const std::string head = "differs at tick 130: the index is not that of the lines before it: ";
  const std::string tail = "\nevery tick up to it is the same\n";
  CHECK(said("\"inputs\":", index).find(head + "its inputs, ") == 0);
  CHECK(said("[60,", index) == head + "row 2 of its keyframes" + tail);
  CHECK(said("\"bot\",", index) == head + "row 1 of its players" + tail);
  CHECK(said("\"leave\",", index).find("of its marks") != std::string::npos);
  CHECK(said("\"index\":", index + 1).find(head + "where it stands, ") == 0);
  // Names, and whole rows.
  Recording altered = recording;
  std::string& line = altered.lines[index];
  line.replace(line.find("louse 2"), 7, "lousy 2");
  CHECK(to_text(verdict(altered.text())) == head + "row 2 of its players" + tail);
  const auto jobs = verify(ReplaySource::of_bytes(altered.text(), "r.jsonl"), 3);
  CHECK(to_text(*jobs) == head + "row 2 of its players" + tail);
  // What a summary says is from the lines.
  const auto summary = inspect_summary(*opened(altered.text()));
  REQUIRE(summary);
  CHECK(summary->find("louse 2\n") != std::string::npos);
  CHECK(summary->find("lousy") == std::string::npos);
  CHECK(summary->find("index    is not that of the lines, which are told here: row 2 of its players\n") !=
        std::string::npos);
  CHECK(inspect_summary(*opened(recording.text()))->find("index  ") == std::string::npos);
}

TEST_CASE("an end without an index is none") {
  Recording recording = record({.steps = 61});
  recording.lines.erase(recording.lines.end() - 2);
  CHECK(verify_text(recording.text()).error().text() ==
        "r.jsonl:" + std::to_string(recording.lines.size()) +
            ": end: has no index before it (a server writes both or neither)");
}

TEST_CASE("a file that can't be read to its end is told, not thrown") {
  // Reading this one fails with EIO from its first byte on.
  const auto result = verify(source_of_file("/proc/self/mem"));
  REQUIRE_FALSE(result);
  CHECK(result.error().text().find("can't be read: ") != std::string::npos);
}

TEST_CASE("a recording that breaks off at any byte is good up to its last whole line") {
  const Recording recording = record({.steps = 61, .keyframe_ticks = 60});
  const std::string text = recording.text();
  const std::size_t first = recording.lines[0].size() + recording.lines[1].size();  // header and keyframe
  std::size_t tail = 0;  // the last two steps, the keyframe between them and the end
  for (std::size_t k = recording.line_of_step(58); k < recording.lines.size(); ++k)
    tail += recording.lines[k].size();
  for (std::size_t length = text.size() - tail; length < text.size(); ++length) {
    const Verification verification = verdict(text.substr(0, length));
    INFO(length);
    CHECK(verification.ok());
    CHECK(verification.cut_off);
    CHECK(verification.ticks == whole_steps(recording, length));
  }
  CHECK(to_text(verdict(text.substr(0, text.size() - 1))) ==
        "ok ticks 0 to 61, then the recording is cut off: it has no end line\n");
  CHECK(to_text(verdict(text.substr(0, first))) ==
        "ok ticks 0 to 0, then the recording is cut off: it has no end line\n");
  CHECK(verify_text(text.substr(0, first - 1)).error().text() ==
        "r.jsonl: was cut off before its first keyframe");
  CHECK_FALSE(verify_text(""));
}

TEST_CASE("lines that are missing, doubled, out of order or behind the end are errors with their line") {
  const Recording recording = record({.steps = 130});
  const auto error_of = [](const std::vector<std::string>& lines) {
    Recording altered;
    altered.lines = lines;
    const auto verification = verify_text(altered.text());
    return verification ? to_text(*verification) : verification.error().text();
  };
  const std::size_t at = recording.line_of_step(100);
  const std::string place = "r.jsonl:" + std::to_string(at + 1);
  auto lines = recording.lines;
  lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
  CHECK(error_of(lines).find(place + ": step 101 stands where step 100 is due") == 0);
  lines = recording.lines;
  lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), lines[at]);
  CHECK(error_of(lines).find("step 100 stands where step 101 is due") != std::string::npos);
  lines = recording.lines;
  lines.push_back(lines[at]);
  CHECK(error_of(lines) == "r.jsonl:" + std::to_string(lines.size()) + ": stands after the end");
  for (const char* behind : {"x", "{\"step\":130,\"hash\":\"0000000000000001\"}", "{"}) {
    lines = recording.lines;
    lines.emplace_back(behind);  // without its newline
    CHECK(error_of(lines) == "r.jsonl:" + std::to_string(lines.size()) + ": stands after the end");
  }
  lines = recording.lines;
  lines.back() = "{\"end\":129,\"reason\":\"\",\"index\":0}\n";
  CHECK(error_of(lines).find("r.jsonl:" + std::to_string(lines.size()) +
                             ": end: tick 129 after step lines up to tick 130") == 0);
  lines = recording.lines;
  lines[at] = "garbage\n";
  CHECK(error_of(lines).find(place + ": not JSON") == 0);
  lines[at] = "\n";
  CHECK(error_of(lines).find(place + ": not JSON") == 0);
  lines[at] = std::string(50000, '[') + "\n";
  CHECK(error_of(lines).find(place + ": nested more than") == 0);
  lines[at] = std::string("{\"step\":100,\0}\n", 15);
  CHECK(error_of(lines).find(place + ": not JSON") == 0);
  const std::size_t keyframe = recording.line_of_step(59) + 1;
  lines = recording.lines;
  std::swap(lines[keyframe], lines[keyframe + 1]);
  CHECK(error_of(lines).find("a keyframe of tick 60 stands where tick 61 is reached") != std::string::npos);
}

TEST_CASE("a join of an id that was used is an error") {
  Recording recording = record({.steps = 130});
  for (std::uint64_t step = 100;; ++step) {
    std::string& line = recording.lines[recording.line_of_step(step)];
    if (line.find("roster") != std::string::npos) continue;
    line.insert(line.find(','), ",\"roster\":[{\"join\":1,\"name\":\"a\",\"role\":\"bot\"}]");
    break;
  }
  const auto verification = verify_text(recording.text());
  REQUIRE_FALSE(verification);
  CHECK(verification.error().text().find(": player 1 joins after player") != std::string::npos);
}

TEST_CASE("a map that was altered in the recording is refused") {
  Recording recording = record({.steps = 3});
  std::string& header = recording.lines.front();
  const NumberPlace drag = find_number(header, "\"drag\":");
  header.replace(drag.begin, drag.end - drag.begin, "0.25");
  const auto verification = verify_text(recording.text());
  REQUIRE_FALSE(verification);
  CHECK(verification.error().text().find("r.jsonl:1: map.hash: the map's hash is ") == 0);
}

TEST_CASE("a recorded definition is the canonical text that a server writes, or refused before it costs") {
  const Recording recording = record({});
  const std::string& header = recording.lines[0];
  constexpr std::string_view kKey = "\"definition\":";
  const std::size_t at = header.find(kKey) + kKey.size();
  const std::string own = header.substr(at, header.size() - std::string_view("}}\n").size() - at);
  const auto refusal = [&](const std::string& definition) {
    Recording altered = recording;
    altered.lines[0] = core::joined({std::string_view(header).substr(0, at), definition, "}}\n"});
    const auto verification = verify_text(altered.text());
    return verification ? to_text(*verification) : verification.error().text();
  };
  CHECK(refusal(own).find("ok ticks") == 0);
  const std::string canonical = ":1: map.definition: is not a map as a program writes it";
  CHECK(refusal("{ " + own.substr(1)).find(canonical) != std::string::npos);
  // Would be four million knots and a spline through them: 700 MB.
  for (const char* surface : {"", R"(,"surface":"spline")", R"(,"surface":"blended")"}) {
    CHECK(refusal(core::joined({R"({"name":"m","terrain":{"function":"volcano","grid":999})", surface, "}"}))
              .find(canonical) != std::string::npos);
  }
  const std::string padded = core::joined({"{", std::string(kMaxInlineMapBytes, ' '), own.substr(1)});
  CHECK(refusal(padded).find(":1: map.definition: longer than 1 MiB") != std::string::npos);
}

TEST_CASE("a large map is named by its hash and found beside the recording") {
  const auto folder = std::filesystem::path(WOODLOUSE_BINARY_DIR) / "tests" / "replay_large_map";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / name, std::ios::binary) << text;
  };
  const std::string map_text = R"({"name":"large","terrain":{"function":"hills","grid":160,"scale":20}})";
  const auto map = map::parse_map(map_text, "large.json", {});
  REQUIRE(map);
  REQUIRE((*map)->canonical.size() > kMaxInlineMapBytes);
  match::Match match(*map, {60, 9});
  std::string text;
  ReplayWriter writer;
  writer.append_header(text, make_header(match, "tests", "somewhere/else/large.json"));
  CHECK(text.size() < 1000);
  writer.append_keyframe(text, match.state());
  match.join();
  for (int k = 0; k < 100; ++k) writer.append_step(text, match.advance());
  writer.append_end(text, "");

  const auto missing = verify_text(text, folder);
  REQUIRE_FALSE(missing);
  CHECK(missing.error().text().find((folder / "large.json").string() + ": no such file") == 0);
  write("large.json", map_text);
  const auto found = verify_text(text, folder);
  REQUIRE(found);
  CHECK(to_text(*found) == "ok ticks 0 to 100\n");
  write("large.json", R"({"name":"large","terrain":{"function":"hills","grid":161,"scale":20}})");
  const auto other = verify_text(text, folder);
  REQUIRE_FALSE(other);
  CHECK(other.error().text().find("put the map it was played on beside the recording") != std::string::npos);
  std::filesystem::remove_all(folder);
}

}  // namespace woodlouse::replay
