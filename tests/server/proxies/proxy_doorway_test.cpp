// Over the loopback address, with a clock that stands still.
#include "server/proxies/proxy_doorway.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <catch2/catch.hpp>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "tests/server/timing/manual_timekeeper.h"

namespace woodlouse::server::proxy_doorway_test {

namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using Verdict = ProxyHeader::Verdict;

constexpr Duration kPatience = std::chrono::seconds(3);
constexpr std::string_view kHeader(
    "\r\n\r\n\0\r\nQUIT\n\x21\x11\x00\x0c\xc0\x00\x02\x01\xc0\x00\x02\x02\x30\x39\x1e\x61", 28);

struct Gate {
  Gate() {
    tcp::acceptor acceptor(io, {asio::ip::address_v4::loopback(), 0});
    far.connect(acceptor.local_endpoint());
    far.set_option(tcp::no_delay(true));
    doorway = std::make_shared<ProxyDoorway>(acceptor.accept(), timekeeper, kPatience);
    doorway->start([this](ProxyHeader header, tcp::socket socket) {
      CHECK_FALSE(came.has_value());
      came = std::move(header);
      near.emplace(std::move(socket));
    });
    io.poll();
  }
  ~Gate() { CHECK(timekeeper.pending() == 0); }
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;

  void say(std::string_view bytes) {
    asio::write(far, asio::buffer(bytes));
    run();
  }
  /// What is there to be done, and what comes in a moment.
  void run() {
    for (int k = 0; k < 20 && !came; ++k) {
      io.restart();
      io.run_one_for(std::chrono::milliseconds(1));
    }
  }
  void until_it_came() {
    for (int k = 0; k < 20'000 && !came; ++k) run();
    REQUIRE(came.has_value());
    io.restart();
    io.poll();  // what was waited for and is no more
  }
  /// What was left in the socket.
  std::string left(std::size_t size) {
    std::string text(size, '\0');
    asio::read(*near, asio::buffer(text));
    CHECK(near->available() == 0);
    return text;
  }

  asio::io_context io{1};
  ManualTimekeeper timekeeper;
  tcp::socket far{io};
  std::shared_ptr<ProxyDoorway> doorway;
  std::optional<ProxyHeader> came;
  std::optional<tcp::socket> near;
};

}  // namespace

TEST_CASE("a header is taken from the socket, and nothing behind it") {
  Gate gate;
  gate.say(std::string(kHeader) + "{\"type\"");
  gate.until_it_came();
  CHECK(gate.came->verdict == Verdict::kWhole);
  CHECK(gate.came->source->to_string() == "192.0.2.1");
  CHECK(gate.left(7) == "{\"type\"");
}

TEST_CASE("a header may come byte by byte") {
  Gate gate;
  for (std::size_t at = 0; at + 1 < kHeader.size(); ++at) {
    gate.say(kHeader.substr(at, 1));
    REQUIRE_FALSE(gate.came.has_value());
  }
  gate.say(kHeader.substr(kHeader.size() - 1));
  gate.until_it_came();
  CHECK(gate.came->verdict == Verdict::kWhole);
  CHECK(gate.near->available() == 0);
  asio::write(gate.far, asio::buffer("{", 1));
  CHECK(gate.left(1) == "{");
}

TEST_CASE("what is no header stays in the socket, whole") {
  for (const std::string_view said : {"{\"type\":\"join\"}", "\r\n\r\n{}", "G", "POST"}) {
    Gate gate;
    gate.say(said);
    gate.until_it_came();
    CHECK(gate.came->verdict == Verdict::kNone);
    CHECK(gate.left(said.size()) == said);
  }
}

TEST_CASE("who says nothing for so long says no header, and who said a part of one is refused") {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{13}, kHeader.size() - 1}) {
    Gate gate;
    if (size > 0) gate.say(kHeader.substr(0, size));
    REQUIRE_FALSE(gate.came.has_value());
    gate.timekeeper.advance(kPatience);
    gate.until_it_came();
    CHECK(gate.came->verdict == (size == 0 ? Verdict::kNone : Verdict::kRefused));
  }
}

TEST_CASE("a connection that ends before its header does is not waited for") {
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, std::size_t{20}}) {
    Gate gate;
    if (size > 0) gate.say(kHeader.substr(0, size));
    gate.far.shutdown(tcp::socket::shutdown_send);
    gate.until_it_came();
    CHECK(gate.came->verdict == (size == 0 ? Verdict::kNone : Verdict::kRefused));
  }
}

TEST_CASE("the end of the server is the end of waiting for a header") {
  Gate gate;
  gate.doorway->end();
  gate.until_it_came();
  CHECK(gate.came->verdict == Verdict::kNone);
}

}  // namespace woodlouse::server::proxy_doorway_test
