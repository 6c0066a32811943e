#include "client/config.h"

#include <unistd.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <vector>

using namespace woodlouse::client;

namespace {

/// An environment of its own, with a config file if asked for; put back at the end.
class Environment {
 public:
  explicit Environment(const std::string& config_json = {}) {
    folder_ =
        std::filesystem::temp_directory_path() / ("woodlouse-config-test-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_ / "woodlouse");
    if (!config_json.empty()) std::ofstream(folder_ / "woodlouse" / "config.json") << config_json;
    set("XDG_CONFIG_HOME", folder_.string());
    for (const char* name :
         {"WOODLOUSE_NAME", "WOODLOUSE_FPS", "WOODLOUSE_COLOR", "WOODLOUSE_SERVER", "WOODLOUSE_GLYPHS",
          "WOODLOUSE_VIEW", "WOODLOUSE_ROOM", "WOODLOUSE_MAP", "WOODLOUSE_STEER", "WOODLOUSE_BELL",
          "WOODLOUSE_WATCH", "WOODLOUSE_VERIFY", "WOODLOUSE_NO_FILES"}) {
      ::unsetenv(name);
    }
  }
  ~Environment() {
    for (const std::string& name : set_) ::unsetenv(name.c_str());
    std::filesystem::remove_all(folder_);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  void set(const std::string& name, const std::string& value) {
    ::setenv(name.c_str(), value.c_str(), 1);
    set_.push_back(name);
  }

 private:
  std::filesystem::path folder_;
  std::vector<std::string> set_;
};

Parsed parse(std::initializer_list<const char*> arguments) {
  std::vector<const char*> argv = {"woodlouse"};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  return parse_arguments(static_cast<int>(argv.size()), argv.data());
}

}  // namespace

TEST_CASE("a flag wins over the environment, that over the config file, that over the default") {
  Environment environment(R"({"name": "file", "fps": 20, "view": "slope"})");
  REQUIRE(parse({}).config.name == "file");
  REQUIRE(parse({}).config.fps == 20);
  environment.set("WOODLOUSE_NAME", "environment");
  REQUIRE(parse({}).config.name == "environment");
  REQUIRE(parse({"--name", "flag"}).config.name == "flag");
  REQUIRE(parse({"--name", "flag"}).config.view == View::kSlope);
}

TEST_CASE("without anything it is a game of its own at 30 frames a second") {
  Environment environment;
  const Parsed parsed = parse({});
  REQUIRE_FALSE(parsed.exit_code);
  REQUIRE_FALSE(parsed.config.server);
  REQUIRE(parsed.config.fps == 30);
  REQUIRE(parsed.config.part == Part::kPlay);
}

TEST_CASE("an address, watching and looks are understood") {
  Environment environment;
  const Parsed parsed = parse({"farm.example:7001", "--watch", "--color", "256", "--glyphs", "half",
                               "--palette", "deutan", "--view", "oblique"});
  REQUIRE_FALSE(parsed.exit_code);
  REQUIRE(parsed.config.server == Address{"farm.example", 7001});
  REQUIRE(parsed.config.part == Part::kWatch);
  REQUIRE(parsed.config.color == ColorChoice::k256);
  REQUIRE(parsed.config.glyphs == GlyphChoice::kHalfBlocks);
  REQUIRE(parsed.config.palette == Palette::kDeutan);
  REQUIRE(parsed.config.view == View::kOblique);
}

TEST_CASE("mistakes end it with 2, one line of what and one of what to do") {
  Environment environment;
  const std::initializer_list<std::initializer_list<const char*>> mistakes = {
      {"--fps", "4"},
      {"--fps", "61"},
      {"--fps", "fast"},
      {"--color", "pink"},
      {"--glyphs", "emoji"},
      {"--palette", "rainbow"},
      {"--nonsense"},
      {"host:0"},
      {"host:99999"},
      {"host:"},
      {":7777"},
      {"[::1"},
      {"::::"},
      {"[farm]:7777"},
      {"[fe80::1%]:7777"},
      {"http://farm:7777"},
      {"farm example:7777"},
      {"7777"},
      {"300.0.0.1"},
      {"--name", ""},
      {"--name", "a name of more than 24 bytes"},
      {"--view", "inside"}};
  for (const auto& arguments : mistakes) {
    const Parsed parsed = parse(arguments);
    REQUIRE(parsed.exit_code == 2);
    REQUIRE(parsed.output.starts_with("woodlouse: "));
    REQUIRE(std::count(parsed.output.begin(), parsed.output.end(), '\n') == 2);
  }
}

TEST_CASE("help and version end it with 0") {
  Environment environment;
  REQUIRE(parse({"--help"}).exit_code == 0);
  REQUIRE(parse({"--help"}).output.find("--watch") != std::string::npos);
  REQUIRE(parse({"--version"}).output == "woodlouse " WOODLOUSE_VERSION "\n");
}

TEST_CASE("help and version are told whatever the config file and the environment say") {
  Environment environment(R"({"colour": "mono"})");
  environment.set("WOODLOUSE_FPS", "fast");
  REQUIRE(parse({}).exit_code == 2);
  CHECK(parse({"--help"}).exit_code == 0);
  CHECK(parse({"--help"}).output.find("--watch") != std::string::npos);
  CHECK(parse({"replay", "--help"}).exit_code == 0);
  CHECK(parse({"--version"}).output == "woodlouse " WOODLOUSE_VERSION "\n");
}

TEST_CASE("a mistake in the config file is told with its line, its field and what to do") {
  for (const auto& [bad, told] : std::initializer_list<std::pair<const char*, const char*>>{
           {"{\"fps\": 20,\n\"colour\": \"mono\"}", "config.json:2: colour: no such setting"},
           {"{\"name\": \"ida\",\n\n\"server\": \"::::\"}",
            "config.json:3: server: address \"::::\": it is no IPv6 address"},
           {"{\n\"view\": \"inside\"}", "config.json:2: view: \"inside\" is none"}}) {
    Environment environment(bad);
    const Parsed parsed = parse({});
    INFO(parsed.output);
    CHECK(parsed.exit_code == 2);
    CHECK(parsed.output.find(told) != std::string::npos);
    CHECK(std::count(parsed.output.begin(), parsed.output.end(), '\n') == 2);
  }
}

TEST_CASE("a bad config file is named with its field") {
  for (const char* bad :
       {R"({"fps": "fast"})", R"({"fps": 99})", R"({"colour": "mono"})", R"([1])", R"({"name": )",
        R"({"watch": 1})", R"({"server": "h:x"})", R"({"fps": 5, "fps": 6})"}) {
    Environment environment(bad);
    const Parsed parsed = parse({});
    REQUIRE(parsed.exit_code == 2);
    REQUIRE(parsed.output.find("config.json") != std::string::npos);
  }
}

TEST_CASE("an address may name the room, and contradicts no other one") {
  Environment environment(R"({"room": "home"})");
  REQUIRE(parse({"farm:7001/crater_loop/race"}).config.room == "crater_loop/race");
  REQUIRE(parse({"farm:7001/crater_loop/race"}).config.server == Address{"farm", 7001});
  REQUIRE(parse({"[::1]/hills"}).config.room == "hills");
  REQUIRE(parse({"farm"}).config.room == "home");
  REQUIRE(parse({"farm/"}).config.room == "home");
  REQUIRE(parse({"farm/hills", "--room", "hills"}).config.room == "hills");
  REQUIRE(parse({"farm/hills", "--room", "volcano"}).exit_code == 2);
}

TEST_CASE("the name is asked for where nobody has said it, by each guest of an account again") {
  {
    Environment environment;
    REQUIRE(parse({}).config.asks_name);
    REQUIRE_FALSE(parse({"--name", "ida"}).config.asks_name);
    REQUIRE(parse({"--no-files", "farm"}).config.asks_name);
    environment.set("WOODLOUSE_NAME", "ida");
    REQUIRE_FALSE(parse({}).config.asks_name);
  }
  Environment environment(R"({"name": "ida"})");
  REQUIRE_FALSE(parse({}).config.asks_name);
}

TEST_CASE("keys and steering of the config file rule, and mistakes in them are named") {
  {
    Environment environment(
        R"({"steer": "heading", "bell": true, "keys": {"up": "z", "left": ["q", "Left"], "quit": ["k"]}})");
    const Parsed parsed = parse({});
    REQUIRE_FALSE(parsed.exit_code);
    CHECK(parsed.config.steer == SteerBy::kHeading);
    CHECK(parsed.config.bell);
    CHECK(parsed.config.keys.find({.character = U'q'}) == Control::kLeft);
    CHECK(parse({"--steer", "compass", "--no-bell"}).config.steer == SteerBy::kCompass);
  }
  for (const auto& [bad, told] : std::initializer_list<std::pair<const char*, const char*>>{
           {R"({"keys": {"fly": "f"}})", "keys.fly: no such action"},
           {R"({"keys": {"up": ["Shift"]}})", "keys.up: \"Shift\" is no key"},
           {R"({"keys": {"up": "q"}})", "keys.quit: no key is left for it"},
           {R"({"keys": {"up": [7]}})", "keys.up: a key is a string"},
           {R"({"keys": {"up": 7}})", "keys.up: it is no key, and no list of keys"},
           {R"({"keys": "wasd"})", "it is no object"},
           {R"({"steer": "wheel"})", "steer: \"wheel\" is none"}}) {
    Environment environment(bad);
    INFO(bad);
    CHECK(parse({}).exit_code == 2);
    CHECK(parse({}).output.find(told) != std::string::npos);
  }
}

TEST_CASE("addresses are read as people write them") {
  REQUIRE(parse_address("localhost").value() == Address{"localhost", 7777});
  REQUIRE(parse_address("[::1]:7001").value() == Address{"::1", 7001});
  REQUIRE(parse_address("::1").value() == Address{"::1", 7777});
  REQUIRE(parse_address("[::1]").value().text() == "[::1]:7777");
  REQUIRE(parse_address("[fe80::1%eth0]:1").value() == Address{"fe80::1%eth0", 1});
  REQUIRE(parse_address("10.0.0.7").value() == Address{"10.0.0.7", 7777});
  REQUIRE(parse_address("k\u00e4fer_1.example").value().host == "k\u00e4fer_1.example");
  REQUIRE_FALSE(parse_address(std::string(254, 'a')));
}

TEST_CASE("the terminal's hints decide the look, choices overrule them, NO_COLOR is obeyed") {
  const auto look = [](TerminalHints hints) {
    return choose_look(ColorChoice::kAuto, GlyphChoice::kAuto, hints, {});
  };
  REQUIRE(look({"xterm-256color", "truecolor", false, true}) ==
          Look{ColorMode::kTruecolor, GlyphSet::kHalfBlocks});
  REQUIRE(look({"xterm-256color", "", false, true}) == Look{ColorMode::k256, GlyphSet::kHalfBlocks});
  REQUIRE(look({"xterm-256color", "truecolor", false, false}) ==
          Look{ColorMode::kTruecolor, GlyphSet::kAscii});
  REQUIRE(look({"linux", "", false, true}) == Look{ColorMode::k16, GlyphSet::kAscii});
  REQUIRE(look({"vt100", "", false, false}) == Look{ColorMode::kMono, GlyphSet::kAscii});
  REQUIRE(look({"xterm-256color", "truecolor", true, true}) == Look{ColorMode::kMono, GlyphSet::kAscii});
  REQUIRE(choose_look(ColorChoice::k16, GlyphChoice::kHalfBlocks, {"xterm", "", true, true}, {}) ==
          Look{ColorMode::k16, GlyphSet::kHalfBlocks});
}

TEST_CASE("replay FILE watches a recording, with the options of the picture before or after it") {
  Environment environment;
  const Parsed parsed = parse({"replay", "game.ndjson", "--color", "mono", "--fps", "20"});
  REQUIRE_FALSE(parsed.exit_code);
  CHECK(parsed.config.part == Part::kReplay);
  CHECK(parsed.config.recording == "game.ndjson");
  CHECK(parsed.config.color == ColorChoice::kMono);
  CHECK(parsed.config.fps == 20);
  CHECK(parse({"--view", "oblique", "replay", "game.ndjson"}).config.view == View::kOblique);
  CHECK(parse({"replay"}).exit_code == 2);
  const Parsed help = parse({"replay", "--help"});
  CHECK(help.exit_code == 0);
  CHECK(help.output.find("woodlouse replay game.ndjson") != std::string::npos);
}

TEST_CASE("hashes are verified where it is asked for, by flag, environment or file") {
  {
    Environment environment;
    CHECK(parse({}).config.hashes == Hashes::kIgnored);
    CHECK(parse({"--watch", "--verify"}).config.hashes == Hashes::kVerified);
    environment.set("WOODLOUSE_VERIFY", "1");
    CHECK(parse({}).config.hashes == Hashes::kVerified);
    CHECK(parse({"--no-verify"}).config.hashes == Hashes::kIgnored);
  }
  Environment environment(R"({"verify": true})");
  CHECK(parse({}).config.hashes == Hashes::kVerified);
}

TEST_CASE("without files nothing is taken from the account: no config file, no name, no server of its own") {
  Environment environment(R"({"name": "file", "server": "farm.example", "fps": "not a number"})");
  environment.set("USER", "game");
  REQUIRE(parse({}).exit_code == 2);  // the file is read
  const Parsed parsed = parse({"--no-files", "farm.example:7000"});
  REQUIRE_FALSE(parsed.exit_code.has_value());
  REQUIRE(parsed.config.no_files);
  REQUIRE(parsed.config.name == "louse");
  REQUIRE(parsed.config.server->text() == "farm.example:7000");
  REQUIRE(parse({"--no-files", "farm.example", "--name=--no-files"}).config.name == "--no-files");
  REQUIRE(parse({"farm.example", "--no-files", "--name", "mara"}).config.name == "mara");
  environment.set("WOODLOUSE_NO_FILES", "1");
  REQUIRE(parse({"farm.example"}).config.no_files);
}

TEST_CASE("without files there is no server to start, and no recording to watch") {
  Environment environment;
  for (const auto arguments :
       {std::initializer_list<const char*>{"--no-files"},
        std::initializer_list<const char*>{"--no-files", "replay", "game.ndjson"},
        std::initializer_list<const char*>{"replay", "game.ndjson", "--no-files"},
        std::initializer_list<const char*>{"--no-files", "farm.example", "replay", "x"}}) {
    const Parsed parsed = parse(arguments);
    REQUIRE(parsed.exit_code == 2);
    REQUIRE(parsed.output.find("--no-files") != std::string::npos);
  }
}

TEST_CASE("rooms are listed of a server that is named") {
  Environment environment;
  CHECK(parse({"--rooms", "farm.example:7777"}).config.part == Part::kRooms);
  CHECK(parse({"farm.example", "--rooms"}).config.server->host == "farm.example");
  CHECK(parse({"--rooms"}).exit_code == 2);
  CHECK(parse({"--rooms"}).output.find("--rooms HOST:PORT") != std::string::npos);
  CHECK(parse({"farm.example"}).config.part == Part::kPlay);
}
