// A room that is at another server: the connection follows, or looks for it.
#include <boost/asio/io_context.hpp>
#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "client/net/connection.h"
#include "client/net/unreachable.h"
#include "shared/protocol/codec.h"
#include "tests/client/net/hosts.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace std::chrono_literals;

namespace {

std::string sent_on(const std::string& address) {
  const protocol::ErrorMessage error{"moved", "there", true, {}, address};
  return protocol::encode(protocol::ServerMessage(error)) + bye("moved", address);
}

std::string no_such_room() {
  return protocol::encode(protocol::ServerMessage(protocol::ErrorMessage{"unknown_room", "none", false, {}}));
}

/// Four servers, of which the first is joined.
struct Servers {
  void join() {
    connection.emplace(context, first.address(), join_of_ann(), listener);
    connection->start();
  }
  /// Until the connection has stopped, or `done`.
  void run(const std::function<bool()>& done = [] { return false; }) {
    const auto end = std::chrono::steady_clock::now() + 20s;
    while (connection->phase() != Connection::Phase::kStopped && !done()) {
      REQUIRE(std::chrono::steady_clock::now() < end);
      context.run_one_for(100ms);
    }
  }
  [[nodiscard]] bool waits() const { return connection->phase() == Connection::Phase::kWaiting; }

  boost::asio::io_context context{1};
  Host first{context}, second{context}, third{context}, fourth{context};
  Listener listener;
  std::optional<Connection> connection;
};

bool says(const std::string& join, const std::string& text) { return join.find(text) != std::string::npos; }

}  // namespace

TEST_CASE("who is in a room that moves follows it at once, into the same louse") {
  Servers stage;
  stage.first.will_answer({welcome(false) + bye("moved", stage.second.address().text())});
  stage.second.will_answer({welcome(true) + bye("replaced")});
  stage.join();
  CHECK_FALSE(says(stage.connection->room(), "volcano"));
  const auto begun = std::chrono::steady_clock::now();
  stage.run();
  CHECK(std::chrono::steady_clock::now() - begun < 1s);
  REQUIRE(stage.second.joins().size() == 1);
  for (const char* text : {R"("resume":"00ff")", R"("room":"volcano")", R"("name":"ann")"})
    CHECK(says(stage.second.joins().front(), text));
  REQUIRE(stage.listener.welcomes.size() == 2);
  CHECK(stage.listener.welcomes.back().resumed);
  CHECK(stage.connection->address() == stage.second.address());
  CHECK(stage.connection->losses() == 1);  // at the end: a move is none
  CHECK(stage.listener.losses == 2);
}

TEST_CASE("who joins a room at the old place is sent on before any welcome, twice") {
  Servers stage;
  stage.first.will_answer({sent_on(stage.second.address().text())});
  stage.second.will_answer({sent_on(stage.third.address().text())});
  stage.third.will_answer({welcome(false) + bye("shutdown")});
  stage.join();
  stage.run();
  CHECK(stage.listener.welcomes.size() == 1);
  REQUIRE(stage.third.joins().size() == 1);
  CHECK(says(stage.third.joins().front(), R"("resume":true)"));
  CHECK(stage.connection->address() == stage.third.address());
}

TEST_CASE("who is sent on a third time before any welcome is told so, and it ends") {
  Servers stage;
  stage.first.will_answer({sent_on(stage.second.address().text())});
  stage.second.will_answer({sent_on(stage.third.address().text())});
  stage.third.will_answer({sent_on(stage.fourth.address().text())});
  stage.join();
  stage.run();
  CHECK(stage.fourth.joins().empty());
  CHECK_FALSE(stage.connection->was_joined());
  const std::string words = why_not_joined(stage.connection->address(), stage.connection->closing()).text();
  CHECK(says(words, "sent on from server to server, to " + stage.fourth.address().text() + " last"));
  CHECK(says(words, stage.third.address().text() + " does not let you in"));
}

TEST_CASE("who was in the room and is sent on a third time has lost the line, and goes on after a wait") {
  Servers stage;
  stage.first.will_answer({welcome(false) + bye("moved", stage.second.address().text())});
  stage.second.will_answer({welcome(true) + bye("moved", stage.third.address().text())});
  stage.third.will_answer({sent_on(stage.fourth.address().text())});
  stage.fourth.will_answer({welcome(true) + bye("replaced")});
  stage.join();
  stage.run([&] { return stage.waits(); });
  CHECK(stage.fourth.joins().empty());
  CHECK(says(stage.connection->closing().reason, "sent on from server to server"));
  CHECK(stage.connection->seconds_left(std::chrono::steady_clock::now()).value_or(0) > 50.0);
  stage.run();
  REQUIRE(stage.fourth.joins().size() == 1);
  CHECK(says(stage.fourth.joins().front(), R"("resume":"00ff")"));
}

TEST_CASE("what is no address is followed by nobody, and told in words") {
  for (const std::string& address :
       {std::string("/tmp/socket"), std::string("unix:/tmp/socket"), std::string("127.0.0.1"),
        std::string("http://127.0.0.1:7777"), std::string("127.0.0.1:0"), std::string("[::1:7777")}) {
    INFO(address);
    Servers stage;
    stage.first.will_answer({welcome(false) + bye("moved", address), welcome(true) + bye("replaced")});
    stage.join();
    stage.run([&] { return stage.waits(); });
    CHECK(stage.connection->closing().reason ==
          "the room has moved to \"" + address + "\", which is no HOST:PORT");
    stage.run();
    CHECK(stage.first.joins().size() == 2);
  }
  Servers stage;
  stage.first.will_answer({sent_on("10.0.0.6")});
  stage.join();
  stage.run();
  CHECK(says(why_not_joined(stage.connection->address(), stage.connection->closing()).text(),
             "which is no HOST:PORT"));
}

TEST_CASE("a room that has moved to nobody knows where is looked for where it was") {
  Servers stage;
  stage.first.will_answer({welcome(false) + bye("moved"), welcome(true) + bye("replaced")});
  stage.join();
  stage.run([&] { return stage.waits(); });
  CHECK(says(stage.connection->closing().reason, "does not say where"));
  stage.run();
  CHECK(stage.first.joins().size() == 2);
}

TEST_CASE("who has lost the line looks for the room at the hosts that were named, in turn") {
  Servers stage;
  stage.first.name({stage.second.address().text(), stage.third.address().text()});
  stage.first.will_answer({welcome(false)});
  stage.third.will_answer({welcome(true) + bye("replaced")});
  stage.second.close();
  stage.join();
  stage.run([&] { return stage.connection->losses() == 1; });
  stage.first.close();
  stage.run();
  REQUIRE(stage.third.joins().size() == 1);
  CHECK(says(stage.third.joins().front(), R"("resume":"00ff")"));
  CHECK(says(stage.third.joins().front(), R"("room":"volcano")"));
  CHECK(stage.connection->address() == stage.third.address());
}

TEST_CASE("who has joined looks for the room at hosts that were named since") {
  Servers stage;
  stage.first.name({stage.second.address().text()});
  const protocol::Ping ping{1, {{stage.third.address().text()}}};
  stage.first.will_answer({welcome(false) + protocol::encode(protocol::ServerMessage(ping))});
  stage.third.will_answer({welcome(true) + bye("replaced")});
  stage.join();
  stage.run([&] { return stage.connection->losses() == 1; });
  stage.first.close();
  stage.run();
  CHECK(stage.second.joins().empty());
  REQUIRE(stage.third.joins().size() == 1);
  CHECK(stage.connection->address() == stage.third.address());
}

TEST_CASE("a server without the room is passed by on the way back, where there are others") {
  Servers stage;
  stage.first.name({stage.second.address().text()});
  stage.first.will_answer({welcome(false), no_such_room()});
  stage.second.will_answer({no_such_room(), welcome(true) + bye("replaced")});
  stage.join();
  stage.run();
  CHECK(stage.second.joins().size() == 2);
  CHECK(stage.listener.welcomes.size() == 2);
  CHECK(stage.connection->closing().code == "replaced");
}

TEST_CASE("without others a server without the room is the end") {
  Servers stage;
  stage.first.will_answer({welcome(false), no_such_room()});
  stage.join();
  stage.run();
  CHECK(stage.first.joins().size() == 2);
  CHECK(stage.connection->closing().code == "unknown_room");
}
