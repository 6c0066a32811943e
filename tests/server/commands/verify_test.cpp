#include "server/commands/verify.h"

#include <sys/stat.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "server/commands/fork.h"
#include "server/commands/inspect.h"
#include "tests/replay/recorded_match.h"

using namespace woodlouse;
using namespace woodlouse::server;

TEST_CASE("verify says its verdict and exits with it") {
  const auto folder = std::filesystem::path(WOODLOUSE_BINARY_DIR) / "tests" / "replay_command";
  std::filesystem::create_directories(folder);
  const auto file = folder / "game.jsonl";
  VerifyRequest request;
  const auto run = [&](const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
    std::ostringstream out;
    request.files = {file};
    const int code = verify_command(request, out);
    return std::pair(code, out.str());
  };
  const replay::Recording recording = replay::record({.steps = 100});
  CHECK(run(recording.text()) == std::pair(0, std::string("ok ticks 0 to 100\n")));
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
  CHECK(verify_command({{folder / "none.jsonl", folder}, {}}, out) == 1);
  CHECK(out.str() == (folder / "none.jsonl").string() +
                         ": no such file (check the path, and the folder it starts from)\n" +
                         folder.string() + ": is a folder, not a file\n");
  std::filesystem::remove_all(folder);
}

TEST_CASE("what is no file to be read ends every command about recordings the same way") {
  const auto folder = std::filesystem::path(WOODLOUSE_BINARY_DIR) / "tests" / "no_recordings";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder / "folder");
  std::ofstream(folder / "empty", std::ios::binary).flush();
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  for (const auto& [name, what] :
       {std::pair("none", ": no such file"), std::pair("folder", ": is a folder"),
        std::pair("pipe", ": is no regular file"), std::pair("empty", ": is empty")}) {
    const std::string told = (folder / name).string() + what;
    std::ostringstream out;
    std::ostringstream errors;
    CHECK(verify_command({{folder / name}, {}}, out) == 1);
    CHECK(out.str().find(told) == 0);
    InspectRequest request;
    request.file = folder / name;
    CHECK(inspect_command(request, out, errors) == 1);
    CHECK(errors.str().find(told) == 0);
    CHECK(open_fork({folder / name, 3}).error().text().find(told) == 0);
  }
  std::filesystem::remove_all(folder);
}

TEST_CASE("who asks for a whole game is told what is missing of it") {
  const auto file = std::filesystem::path(WOODLOUSE_BINARY_DIR) / "tests" / "verify_whole.jsonl";
  const replay::Recording whole = replay::record({.steps = 100});
  replay::Recording late = whole;
  late.lines.erase(late.lines.begin() + 1,
                   late.lines.begin() + static_cast<std::ptrdiff_t>(late.line_of_step(59)) + 1);
  replay::Recording cut = whole;
  cut.lines.pop_back();
  const auto code = [&](const replay::Recording& recording, bool from_start, bool complete) {
    std::ofstream(file, std::ios::binary)
        << (recording.lines[1] == late.lines[1] ? recording.text_with_own_index() : recording.text());
    VerifyRequest request{{file}, {}, 1, from_start, complete};
    std::ostringstream out;
    const int result = verify_command(request, out);
    CHECK(out.str().find("ok ticks ") == 0);
    CHECK((out.str().find("--from-start") != std::string::npos) == (from_start && result == 1));
    CHECK((out.str().find("--complete") != std::string::npos) == (complete && !from_start && result == 1));
    return result;
  };
  for (const bool from_start : {false, true}) {
    for (const bool complete : {false, true}) {
      CHECK(code(whole, from_start, complete) == 0);
      CHECK(code(late, from_start, complete) == (from_start ? 1 : 0));
    }
  }
  CHECK(code(cut, true, false) == 0);
  CHECK(code(cut, false, true) == 1);
  std::filesystem::remove(file);
}
