#include "server/net/web_answers.h"

#include <catch2/catch.hpp>

#include <memory>
#include <string>
#include <vector>

#include "tests/server/net/session_stage.h"

namespace woodlouse::server::web_answers_test {

namespace {

WebAnswer asked(const std::string& target, const std::string& room = "volcano", bool is_stopping = false,
                bool are_ticks_overdue = false) {
  const FakeDirectory directory({std::make_shared<FakeDoor>(room)});
  return answer_to(target, "10.0.0.1", directory, {"woodlouse <1.2>", 7777, is_stopping, are_ticks_overdue});
}

bool has(const WebAnswer& answer, std::string_view text) {
  return answer.body.find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("the front page says what this is, which rooms there are and how to join, and nothing raw") {
  const WebAnswer page = asked("/?x=<y>", "<b>\"a\"&'c'</b>");
  CHECK(page.status == 200);
  CHECK(page.type == "text/html; charset=utf-8");
  CHECK(has(page, "woodlouse &lt;1.2&gt;"));
  CHECK(has(page, "<td>&lt;b&gt;&quot;a&quot;&amp;&#39;c&#39;&lt;/b&gt;<td>"));
  CHECK(has(page, "nc 10.0.0.1 7777\n"));
  CHECK(has(page, "woodlouse 10.0.0.1:7777"));
  CHECK_FALSE(has(page, "<b>"));
  CHECK_FALSE(has(page, "<y>"));
}

TEST_CASE("the rooms are the array of the message rooms") {
  const WebAnswer rooms = asked("/rooms", "a]b");
  CHECK(rooms.type == "application/json");
  CHECK(rooms.body == R"([{"name":"a]b","map":"a]b","players":0,"bots":0,"spectators":0}])"
                      "\n");
}

TEST_CASE("who looks after a server is told whether it lives, and whether it is ready") {
  CHECK(asked("/healthz").body == "ok\n");
  CHECK(asked("/healthz", "volcano", true).status == 200);
  CHECK(asked("/readyz?now").status == 200);
  CHECK(asked("/readyz", "volcano", true).status == 503);
  CHECK(asked("/readyz", "volcano", false, true).status == 503);
  CHECK(asked("/healthz", "volcano", false, true).status == 200);
}

TEST_CASE("of a page that is not there nothing comes back") {
  for (const auto* target : {"/nowhere", "", "*", "http://a/", "/rooms/", "/../etc/passwd"}) {
    const WebAnswer answer = asked(target);
    CHECK(answer.status == 404);
    CHECK(answer.body == asked("/x").body);
  }
}

}  // namespace woodlouse::server::web_answers_test
