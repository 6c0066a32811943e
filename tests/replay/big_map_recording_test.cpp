// A recording of a game on a map whose heights stay in their file.
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "shared/map/map_file.h"
#include "shared/replay/writer.h"
#include "tests/replay/recorded_match.h"
#include "tests/support/big_map_files.h"

namespace woodlouse::replay {

TEST_CASE(
    "a game on a map in tiles is recorded with its file's name, verifies beside it and refuses another "
    "file") {
  const tests::BigMapFiles files("recording");
  const auto map = map::load_map(files.map(R"(,"storage":"tiles")"));
  REQUIRE(map);
  match::Match match(*map, {60, 9});
  std::string text;
  ReplayWriter writer;
  writer.append_header(text, make_header(match, "tests", "somewhere/else/hills.json"));
  CHECK(text.find("\"definition\"") == std::string::npos);
  writer.append_keyframe(text, match.state());
  for (int k = 0; k < 20; ++k) match.join();
  for (int k = 0; k < 200; ++k) writer.append_step(text, match.advance());
  writer.append_end(text, "");

  const auto verdict = [&] {
    const auto verification = verify_text(text, files.folder());
    return verification ? to_text(*verification) : verification.error().text();
  };
  CHECK(verdict() == "ok ticks 0 to 200\n");
  // Under a spawn point, so on the lice's way; and in a row that the fingerprint of so small a map holds
  // anyway.
  files.alter(145, 75, 201, 9.0f);
  CHECK(verdict().find("put the map it was played on beside the recording") != std::string::npos);
  std::filesystem::remove(files.file("hills.flt"));
  CHECK(verdict().find("hills.flt: can't be opened") != std::string::npos);
  std::filesystem::remove(files.file("hills.json"));
  CHECK(verdict().find(files.file("hills.json").string() + ": no such file") == 0);
}

}  // namespace woodlouse::replay
