#include "server/web/web_answers.h"

#include <catch2/catch.hpp>

#include <memory>
#include <string>
#include <vector>

#include "tests/server/net/session_stage.h"

namespace woodlouse::server::web_answers_test {

namespace {

WebAnswer asked(const std::string& target, const std::string& room = "volcano", bool is_stopping = false,
                bool are_ticks_overdue = false) {
  FakeDirectory directory({std::make_shared<FakeDoor>(room)});
  directory.are_ticks_overdue = are_ticks_overdue;
  return answer_to({target, "10.0.0.1"}, directory, {"woodlouse <1.2>", 7777, is_stopping}, Time{});
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
  CHECK(asked("/readyz", "volcano", false, true).body == "ticks are overdue\n");
  CHECK(asked("/healthz", "volcano", false, true).status == 200);
}

TEST_CASE("of a page that is not there nothing comes back") {
  for (const auto* target : {"/nowhere", "", "*", "http://a/", "/rooms/", "/../etc/passwd"}) {
    const WebAnswer answer = asked(target);
    CHECK(answer.status == 404);
    CHECK(answer.body == asked("/x").body);
  }
}

TEST_CASE("where there is a page it is at /, and what this is at /about") {
  const EmbeddedFile kFiles[] = {{"index.html", "<!doctype html>", ""}, {"page.js", "export {};", "packed"}};
  const auto pages = built_in_pages({"00c0ffee00c0ffee", kFiles});
  const FakeDirectory directory({std::make_shared<FakeDoor>("volcano")});
  const auto ask = [&](WebQuestion question) {
    question.host = "10.0.0.1";
    return answer_to(question, directory, {"woodlouse", 7777, false, pages.get()}, Time{});
  };
  const WebAnswer page = ask({"/?room=volcano", ""});
  CHECK(page.content() == "<!doctype html>");
  CHECK(page.cache == "no-cache");
  CHECK(has(ask({"/about", ""}), "nc 10.0.0.1 7777\n"));
  CHECK(ask({"/rooms", ""}).type == "application/json");

  const WebAnswer script = ask({"/00c0ffee00c0ffee/page.js", "", "gzip"});
  CHECK((script.is_packed && script.varies && script.content() == "packed"));
  CHECK(script.cache == "public, max-age=31536000, immutable");
  const WebAnswer again = ask({"/00c0ffee00c0ffee/page.js", "", "gzip", script.etag});
  CHECK((again.status == 304 && again.content().empty() && again.etag == script.etag));
  CHECK(ask({"/00c0ffee00c0ffee/page.js", "", "", script.etag}).status == 200);
  CHECK(ask({"/00c0ffee00c0ffee/other.js", ""}).status == 404);
}

}  // namespace woodlouse::server::web_answers_test
