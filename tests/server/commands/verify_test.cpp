#include "server/commands/verify.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "tests/replay/recorded_match.h"

using namespace woodlouse;
using namespace woodlouse::server;

TEST_CASE("verify says its verdict and exits with it") {
  const auto folder = std::filesystem::path(WOODLOUSE_BINARY_DIR) / "tests" / "replay_command";
  std::filesystem::create_directories(folder);
  const auto file = folder / "game.jsonl";
  const auto run = [&](const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
    std::ostringstream out;
    const int code = verify_command({file}, 1, out);
    return std::pair(code, out.str());
  };
  const replay::Recording recording = replay::record({.steps = 100});
  CHECK(run(recording.text()) == std::pair(0, std::string("ok 100 ticks\n")));
  replay::Recording altered = recording;
  std::string& line = altered.lines[altered.line_of_step(40)];
  line[line.size() - 4] = line[line.size() - 4] == '0' ? '1' : '0';
  const auto [code, text] = run(altered.text());
  CHECK(code == 1);
  CHECK(text.find("differs at tick 41: hash ") == 0);
  CHECK(text.find("\nkeyframe 60: the same lice") != std::string::npos);
  CHECK(std::count(text.begin(), text.end(), '\n') == 2);
  CHECK(run("x\n").first == 1);
  std::ostringstream out;
  CHECK(verify_command({folder / "none.jsonl", folder}, 1, out) == 1);
  CHECK(out.str() == (folder / "none.jsonl").string() + ": can't be opened: No such file or directory\n" +
                         folder.string() + ": is a folder, not a recording\n");
  std::filesystem::remove_all(folder);
}
