// A recording of a game on a map whose heights stay in their file.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "shared/map/map_file.h"
#include "shared/replay/source_file.h"
#include "shared/replay/verify.h"
#include "shared/replay/writer.h"
#include "tests/replay/recorded_match.h"
#include "tests/support/big_map_files.h"

namespace woodlouse::replay {
namespace {

/// A game from its beginning, its map named as that file.
std::string recorded(match::Match& match, const std::string& map_file, int players, int ticks) {
  std::string text;
  ReplayWriter writer;
  writer.append_header(text, make_header(match, "tests", map_file));
  writer.append_keyframe(text, match.state());
  for (int k = 0; k < players; ++k) match.join();
  for (int k = 0; k < ticks; ++k) writer.append_step(text, match.advance());
  writer.append_end(text, "");
  return text;
}

}  // namespace

TEST_CASE(
    "a game on a map in tiles is recorded with its file's name, verifies beside it and refuses another "
    "file") {
  const tests::BigMapFiles files("recording");
  const auto map = map::load_map(files.map(R"(,"storage":"tiles")"));
  REQUIRE(map);
  match::Match match(*map, {60, 9});
  const std::string text = recorded(match, "somewhere/else/hills.json", 20, 200);
  CHECK(text.find("\"definition\"") == std::string::npos);

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
  CHECK(verdict().find("hills.flt: no such file") != std::string::npos);
  std::filesystem::remove(files.file("hills.json"));
  CHECK(verdict().find(files.file("hills.json").string() + ": no such file") == 0);
}

TEST_CASE(
    "what a recording or a map names is not reached by a link out of its folder, what the user links is") {
  namespace fs = std::filesystem;
  const tests::BigMapFiles files("links");
  const auto map = map::load_map(files.map(R"(,"storage":"tiles")"));
  REQUIRE(map);
  match::Match match(*map, {60, 9});
  const std::string text = recorded(match, "hills.json", 0, 1);
  const fs::path folder = files.folder() / "came";
  fs::create_directories(folder);
  std::ofstream(folder / "game.ndjson", std::ios::binary) << text;
  const auto verdict = [&](const fs::path& maps = {}) {
    const auto verification = verify(source_of_file(folder / "game.ndjson", maps));
    return verification ? to_text(*verification) : verification.error().text();
  };
  const auto out_of_folder = [](const fs::path& file) {
    return file.string() + ": leads out of its folder (put the file itself there, not a link)";
  };

  fs::create_symlink(files.file("hills.json"), folder / "hills.json");
  CHECK(verdict() == out_of_folder(folder / "hills.json"));
  fs::remove(folder / "hills.json");
  fs::copy(files.file("hills.json"), folder / "hills.json");
  for (const char* name : {"hills.flt", "hills.hdr"}) {
    const char* const other = name == std::string("hills.flt") ? "hills.hdr" : "hills.flt";
    fs::create_symlink(files.file(name), folder / name);
    fs::copy(files.file(other), folder / other);
    CHECK(verdict() == out_of_folder(folder / name));
    fs::remove(folder / name);
    fs::remove(folder / other);
  }
  for (const char* name : {"hills.flt", "hills.hdr"}) fs::rename(files.file(name), folder / name);
  CHECK(verdict() == "ok ticks 0 to 1\n");

  // The user's own folder, in which he has a link to the map; its grid lies there.
  const fs::path own = files.folder() / "own";
  fs::create_directories(own);
  for (const char* name : {"hills.flt", "hills.hdr"}) fs::rename(folder / name, own / name);
  fs::remove(folder / "hills.json");
  fs::create_symlink(files.file("hills.json"), own / "hills.json");
  CHECK(verdict(own) == "ok ticks 0 to 1\n");
}

}  // namespace woodlouse::replay
