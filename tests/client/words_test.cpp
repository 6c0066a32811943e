// What people are asked and told before a game begins, and what is kept of it.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "client/config_file.h"
#include "client/name_question.h"
#include "client/net/unreachable.h"
#include "shared/core/whole_file.h"

using namespace woodlouse::client;

namespace {

std::optional<std::string> answered(const std::string& typed, std::string& asked) {
  std::istringstream in(typed);
  std::ostringstream out;
  const auto name = ask_for_name("mara", in, out);
  asked = out.str();
  return name;
}

}  // namespace

TEST_CASE("the name is asked for until a server would take it") {
  std::string asked;
  CHECK(answered("\n", asked) == "mara");
  CHECK(asked == "What is your louse called? [mara] ");
  CHECK(answered("  ida lou \r\n", asked) == "ida lou");
  CHECK(answered("K\xc3\xa4the\n", asked) == "K\xc3\xa4the");
  CHECK(answered("twenty-five bytes are more\nida\n", asked) == "ida");
  CHECK(asked.find("At most 24 bytes") != std::string::npos);
  CHECK(answered("\x1b[31mred\nida\n", asked) == "ida");
  CHECK(answered("\xff\xfe\nida\n", asked) == "ida");
  CHECK_FALSE(answered("", asked));
}

TEST_CASE("the name is written beside what stands in the config file") {
  CHECK(with_name("", "ida") == "{\"name\": \"ida\"}\n");
  CHECK(with_name("{}", "ida") == "{\"name\": \"ida\"}");
  CHECK(with_name("{\n  \"fps\": 20\n}\n", "i\"d") == "{\"name\": \"i\\\"d\", \n  \"fps\": 20\n}\n");
  const auto folder =
      std::filesystem::temp_directory_path() / ("woodlouse-name-" + std::to_string(::getpid()));
  const auto file = folder / "woodlouse" / "config.json";
  REQUIRE(remember_name(file, "ida"));
  CHECK(woodlouse::core::read_whole_file(file, 100).value() == "{\"name\": \"ida\"}\n");
  // Somebody has written to it meanwhile.
  for (const char* text : {"\n", "null", "[1]", "{\"fps\": 20", "no { json }"}) {
    INFO(text);
    std::ofstream(file) << text;
    CHECK_FALSE(remember_name(file, "ida"));
    CHECK(woodlouse::core::read_whole_file(file, 100).value() == text);
  }
  // Another client was asked at the same time, and was answered first: its name is there once.
  std::ofstream(file) << "{\"name\": \"ada\"}";
  CHECK(remember_name(file, "ida"));
  CHECK(woodlouse::core::read_whole_file(file, 100).value() == "{\"name\": \"ada\"}");
  // Who keeps it elsewhere and links to it goes on doing so.
  const auto elsewhere = folder / "kept.json";
  std::filesystem::remove(file);
  std::ofstream(elsewhere) << "{}";
  std::filesystem::create_symlink(elsewhere, file);
  REQUIRE(remember_name(file, "ida"));
  CHECK(std::filesystem::is_symlink(file));
  CHECK(woodlouse::core::read_whole_file(elsewhere, 100).value() == "{\"name\": \"ida\"}");
  std::filesystem::remove_all(folder);
  std::ofstream(folder) << "no folder";
  CHECK_FALSE(remember_name(file, "ida"));
  std::filesystem::remove_all(folder);
}

TEST_CASE("who could not join is told how far it came, and what may help") {
  const Address address{"farm", 7001};
  const auto told = [&](Closing closing, Reached reached) {
    closing.reached = reached;
    const auto error = why_not_joined(address, closing);
    return error.where + ": " + error.what + " / " + error.hint;
  };
  CHECK(told({"host not found"}, Reached::kNothing).find("farm:7001: host not found / is the name spelt") !=
        std::string::npos);
  CHECK(told({kConnectionRefused}, Reached::kName)
            .find("woodlouse-server --map volcano --listen 0.0.0.0:7001") != std::string::npos);
  CHECK(told({"no answer within 3 s"}, Reached::kName).find("firewall") != std::string::npos);
  CHECK(told({"it takes the connection and says nothing"}, Reached::kHost).find("TLS") != std::string::npos);
  CHECK(told({"join.room: no room \"nope\"; there are: a b", "unknown_room"}, Reached::kServer) ==
        "farm:7001 does not let you in: no room \"nope\"; there are: a b / name one of them:  woodlouse "
        "farm:7001/ROOM");
  CHECK(told({"the room is full", "room_full"}, Reached::kServer) ==
        "farm:7001 does not let you in: the room is full / ");
}
