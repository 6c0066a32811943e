// The connection against a server of the test's own on the same io_context, which does what a test says at
// each join.
#include "client/net/connection.h"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/streambuf.hpp>
#include <boost/asio/write.hpp>
#include <catch2/catch.hpp>
#include <functional>
#include <istream>
#include <string>
#include <vector>

#include "client/net/link.h"
#include "shared/protocol/codec.h"

using namespace woodlouse;
using namespace woodlouse::client;
using namespace std::chrono_literals;
namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

namespace {

std::string welcome(bool resumed) {
  protocol::Welcome message;
  message.id = 3;
  message.name = "ann";
  message.resume_token = "00ff";
  message.resumed = resumed;
  message.fields = protocol::default_columns();
  message.room = message.map_name = "volcano";
  message.mode = "roam";
  message.extent = {-1, -1, 1, 1};
  return protocol::encode(protocol::ServerMessage(message));
}

/// Answers the n-th join with the n-th text, and resets the connection where that text ends without a bye.
class Host {
 public:
  Host(asio::io_context& context, std::vector<std::string> answers)
      : context_(context), acceptor_(context, Tcp::endpoint(asio::ip::address_v4::loopback(), 0)) {
    for (std::string& answer : answers) answers_.push_back(std::move(answer));
    accept();
  }
  [[nodiscard]] Address address() const { return {"127.0.0.1", acceptor_.local_endpoint().port()}; }
  [[nodiscard]] const std::vector<std::string>& joins() const { return joins_; }

 private:
  struct Guest {
    explicit Guest(asio::io_context& context) : socket(context) {}
    Tcp::socket socket;
    asio::streambuf bytes;
  };

  void accept() {
    auto guest = std::make_shared<Guest>(context_);
    acceptor_.async_accept(guest->socket, [this, guest](boost::system::error_code error) {
      if (error) return;
      accept();
      asio::write(guest->socket, asio::buffer(protocol::encode(protocol::ServerMessage(protocol::Hello{}))));
      asio::async_read_until(guest->socket, guest->bytes, '\n',
                             [this, guest](boost::system::error_code failed, std::size_t) {
                               if (!failed) on_join(*guest);
                             });
    });
  }
  void on_join(Guest& guest) {
    std::istream lines(&guest.bytes);
    std::getline(lines, joins_.emplace_back());
    const std::string& answer = answers_.at(joins_.size() - 1);
    asio::write(guest.socket, asio::buffer(answer));
    guest.socket.shutdown(Tcp::socket::shutdown_send);
  }

  asio::io_context& context_;
  Tcp::acceptor acceptor_;
  std::vector<std::string> answers_, joins_;
};

struct Listener final : ConnectionListener {
  void on_message(const protocol::ServerMessage& message, core::Time) override {
    if (const auto* said = std::get_if<protocol::Welcome>(&message)) welcomes.push_back(*said);
  }
  void on_lost() override { ++losses; }
  std::vector<protocol::Welcome> welcomes;
  int losses = 0;
};

struct Stage {
  explicit Stage(std::vector<std::string> answers) : host(context, std::move(answers)) {
    protocol::Join join;
    join.name = "ann";
    join.fields = protocol::default_columns();
    join.may_resume = true;
    connection.emplace(context, host.address(), join, listener);
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

std::string bye(const char* code) {
  return protocol::encode(protocol::ServerMessage(protocol::Bye{code, "so it is", false}));
}

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
  CHECK(*left > 20.0);
  CHECK(*left <= 30.0);
}

TEST_CASE("it ends where the next attempt would come too late") {
  Stage stage({welcome(false), refusal("rate_limited", 40000)});
  stage.run();
  CHECK(stage.host.joins().size() == 2);
  CHECK(is_passing(stage.connection->closing()));
}

TEST_CASE("what a server says for good is told from what passes") {
  for (const char* code :
       {"", "rate_limited", "too_many_connections", "idle", "slow", "left", "handshake_timeout"})
    CHECK(is_passing({"", code}));
  for (const char* code : {"shutdown", "replaced", "flood", "bad_protocol", "line_too_long", "unknown_room",
                           "room_full", kNoServerOfOurs})
    CHECK_FALSE(is_passing({"", code}));
}
