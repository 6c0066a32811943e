#include "server/admin/command.h"

#include <catch2/catch.hpp>

#include <string>

#include "server/admin/answer.h"
#include "shared/json/document.h"

namespace woodlouse::server::command_test {

namespace {

Command decoded(const std::string& line) {
  const auto result = decode_command(line);
  INFO(line);
  REQUIRE(result);
  return result->command;
}

std::string code_of(const std::string& line) {
  const auto result = decode_command(line);
  return result ? "taken" : result.error().code;
}

}  // namespace

TEST_CASE("a command is read with what it takes") {
  CHECK(decoded(R"({"type":"status"})").verb == Verb::kStatus);
  const Command ban = decoded(R"({"type":"ban","who":"192.0.2.0/24","seconds":3600})");
  CHECK(ban.verb == Verb::kBan);
  CHECK(ban.who == "192.0.2.0/24");
  CHECK(decoded(R"({"type":"ban","who":"2001:db8:1234:5678:9abc:def0:1234:5678"})").who.size() == 38);
  CHECK(ban.seconds == 3600);
  CHECK_FALSE(decoded(R"({"type":"ban","who":"ann"})").seconds);
  const Command open = decoded(R"({"type":"open","file":"maps/a b.json","name":"evening"})");
  CHECK(open.file == "maps/a b.json");
  CHECK(open.name == "evening");
  CHECK(decoded(R"({"type":"step"})").ticks == 1);
  CHECK(decoded(R"({"type":"step","ticks":36000,"room":"hills"})").room == "hills");
  CHECK(decoded(R"({"type":"record","on":true})").on);
  CHECK(decoded(R"({"type":"drain","seconds":0})").seconds == 0);
  CHECK(decode_command(R"({"type":"rooms","token":"correct-horse"})")->token == "correct-horse");
}

TEST_CASE("what is wrong with a command is said in the wire's codes") {
  CHECK(code_of("") == "bad_json");
  CHECK(code_of("status") == "bad_json");
  CHECK(code_of("[]") == "not_an_object");
  CHECK(code_of(R"({"type":"sttus"})") == "unknown_type");
  CHECK(code_of(R"({"type":"kick"})") == "missing_field");
  CHECK(code_of(R"({"type":"kick","who":7})") == "bad_field");
  CHECK(code_of(R"({"type":"ban","who":"ann","seconds":0})") == "bad_field");
  CHECK(code_of(R"({"type":"ban","who":"ann","seconds":1.5})") == "bad_field");
  CHECK(code_of(R"({"type":"ban","who":"ann","seconds":864000001})") == "bad_field");
  CHECK(code_of(R"({"type":"drain","seconds":86401})") == "bad_field");
  CHECK(code_of(R"({"type":"step","ticks":36001})") == "bad_field");
  CHECK(code_of(R"({"type":"record","on":"yes"})") == "bad_field");
  CHECK(code_of(R"({"type":"say","text":""})") == "bad_field");
  CHECK(code_of(R"({"type":"ban","who":""})") == "bad_field");
  CHECK(code_of(R"({"type":"ban","who":"\u0007\u200b"})") == "bad_field");
  CHECK(code_of(R"({"type":"close","room":""})") == "bad_field");
  CHECK(code_of(R"({"type":"open","file":""})") == "bad_field");
  CHECK(code_of(R"({"type":"open","file":"a\u0000b"})") == "bad_field");
  CHECK(code_of(R"({"type":"open","file":")" + std::string(4097, 'a') + R"("})") == "bad_field");
}

TEST_CASE("a field that a command does not take is no slip to pass over") {
  CHECK(code_of(R"({"type":"ban","who":"ann","second":60})") == "bad_field");
  CHECK(code_of(R"({"type":"status","who":"ann"})") == "bad_field");
  CHECK(decode_command(R"({"type":"ban","who":"ann","second":60})").error().text ==
        "ban has no field second; it takes who, seconds");
}

TEST_CASE("each verb goes over the door and comes out as it went in") {
  for (int k = 0; k <= static_cast<int>(Verb::kShutdown); ++k) {
    Command command;
    command.verb = static_cast<Verb>(k);
    const std::string verb(to_text(command.verb));
    INFO(verb);
    if (verb == "kick" || verb == "ban" || verb == "unban" || verb == "mute" || verb == "unmute")
      command.who = "\"ann\" \\ \xc3\xa9";
    if (verb == "say") command.text = "good evening";
    if (verb == "open") command.file = "/maps/hills.json";
    if (verb == "close" || verb == "pause") command.room = "hills/race";
    if (verb == "step") command.ticks = 30;
    if (verb == "drain" || verb == "ban") command.seconds = 60;
    command.on = verb == "record";
    std::string line = encode({command, "a-token-of-some"});
    REQUIRE(line.ends_with('\n'));
    line.pop_back();
    const auto back = decode_command(line);
    REQUIRE(back);
    CHECK(back->token == "a-token-of-some");
    CHECK(back->command.verb == command.verb);
    CHECK(back->command.who == command.who);
    CHECK(back->command.text == command.text);
    CHECK(back->command.file == command.file);
    CHECK(back->command.room == command.room);
    CHECK(back->command.ticks == command.ticks);
    CHECK(back->command.seconds == command.seconds);
    CHECK(back->command.on == command.on);
  }
}

TEST_CASE("answers are JSON, a line each, whatever is in them") {
  const std::string nasty = "a \"b\"\n\\ \x01 \xff";
  for (const std::string& line : {done(nasty), refused(admin_code::kNobody, nasty)}) {
    CHECK(line.find('\n') == line.size() - 1);
    CHECK(json::parse(line, {8, 100}));
  }
}

}  // namespace woodlouse::server::command_test
