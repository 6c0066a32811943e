// The connection against a server of the test's own.
#include "client/net/connection.h"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <catch2/catch.hpp>
#include <functional>
#include <string>
#include <vector>

#include "client/net/link.h"
#include "shared/protocol/codec.h"
#include "tests/client/net/hosts.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace std::chrono_literals;
namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

namespace {

struct Stage {
  explicit Stage(std::vector<std::string> answers) : host(context, std::move(answers)) {
    connection.emplace(context, host.address(), join_of_ann(), listener);
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
  asio::io_context context{1};
  Host host;
  Listener listener;
  std::optional<Connection> connection;
};

std::string refusal(const char* code, std::optional<std::uint32_t> retry_after_ms) {
  return protocol::encode(
      protocol::ServerMessage(protocol::ErrorMessage{code, "not now", false, retry_after_ms}));
}

}  // namespace

TEST_CASE("a connection that breaks comes back with its token, and ends at a bye that means it") {
  Stage stage({welcome(false), welcome(true) + bye("replaced")});
  stage.run();
  REQUIRE(stage.host.joins().size() == 2);
  CHECK(stage.host.joins()[0].find(R"("resume":true)") != std::string::npos);
  CHECK(stage.host.joins()[1].find(R"("resume":"00ff")") != std::string::npos);
  REQUIRE(stage.listener.welcomes.size() == 2);
  CHECK(stage.listener.welcomes[1].resumed);
  CHECK(stage.connection->losses() == 2);
  CHECK(stage.connection->closing().code == "replaced");
  CHECK(stage.connection->closing().reason == "so it is");
  CHECK_FALSE(stage.connection->seconds_left(std::chrono::steady_clock::now()));
}

TEST_CASE("a join that comes too fast is made again when the server says") {
  const auto begun = std::chrono::steady_clock::now();
  Stage stage({refusal("rate_limited", 1300), welcome(false) + bye("shutdown")});
  stage.run();
  CHECK(std::chrono::steady_clock::now() - begun >= 1300ms);
  CHECK(stage.host.joins().size() == 2);
  CHECK(stage.listener.welcomes.size() == 1);
}

TEST_CASE("a join that is refused, or that nobody answers, is not made again") {
  Stage refused({refusal("room_full", {})});
  refused.run();
  CHECK(refused.connection->closing().reason == "not now");
  CHECK_FALSE(refused.connection->was_joined());
  Stage unanswered({""});
  unanswered.run();
  CHECK(unanswered.host.joins().size() == 1);
}

TEST_CASE("a port that takes connections and says nothing is given up after 2 s") {
  asio::io_context context{1};
  Tcp::acceptor silent(context, Tcp::endpoint(asio::ip::address_v4::loopback(), 0));
  Listener listener;
  protocol::Join join;
  join.name = "ann";
  Connection connection(context, {"127.0.0.1", silent.local_endpoint().port()}, join, listener);
  const auto begun = std::chrono::steady_clock::now();
  connection.start();
  while (connection.phase() != Connection::Phase::kStopped) context.run_one_for(100ms);
  CHECK(std::chrono::steady_clock::now() - begun < 3s);
  CHECK(connection.closing().reached == Reached::kHost);
}

TEST_CASE("who sends what no server of ours begins with is not listened to for long") {
  for (const std::string& said :
       {std::string(Link::kMaxHelloBytes + 2, 'x'), std::string("HTTP/1.1 400 Bad Request\r\n\r\n")}) {
    asio::io_context context{1};
    Tcp::acceptor acceptor(context, Tcp::endpoint(asio::ip::address_v4::loopback(), 0));
    Tcp::socket guest(context);
    acceptor.async_accept(guest, [&](boost::system::error_code error) {
      REQUIRE_FALSE(error);
      asio::write(guest, asio::buffer(said));  // and stays connected
    });
    Listener listener;
    protocol::Join join;
    join.name = "ann";
    Connection connection(context, {"127.0.0.1", acceptor.local_endpoint().port()}, join, listener);
    const auto begun = std::chrono::steady_clock::now();
    connection.start();
    while (connection.phase() != Connection::Phase::kStopped) context.run_one_for(100ms);
    CHECK(std::chrono::steady_clock::now() - begun < 1s);
    CHECK(connection.closing().reached == Reached::kHost);
    CHECK(connection.closing().code == kNoServerOfOurs);
    CHECK(connection.closing().reason.find("no woodlouse server answers there: ") == 0);
  }
}

TEST_CASE("while it tries, it says for how long it will") {
  Stage stage({welcome(false), refusal("rate_limited", 5000)});
  stage.run([&] { return stage.host.joins().size() == 2 && stage.listener.losses == 2; });
  CHECK(stage.connection->phase() == Connection::Phase::kWaiting);
  const auto left = stage.connection->seconds_left(std::chrono::steady_clock::now());
  REQUIRE(left);
  CHECK(*left > 50.0);
  CHECK(*left <= 60.0);
}

TEST_CASE("it ends where the next attempt would come too late") {
  Stage stage({welcome(false), refusal("rate_limited", 70000)});
  stage.run();
  CHECK(stage.host.joins().size() == 2);
  CHECK(is_passing(stage.connection->closing()));
}

TEST_CASE("what a server says for good is told from what passes") {
  for (const char* code :
       {"", "rate_limited", "too_many_connections", "idle", "slow", "left", "handshake_timeout", "moved"})
    CHECK(is_passing({"", code}));
  for (const char* code : {"shutdown", "replaced", "flood", "bad_protocol", "line_too_long", "unknown_room",
                           "room_full", kNoServerOfOurs})
    CHECK_FALSE(is_passing({"", code}));
}
