// HTTP over the loopback address, with a clock that stands still.
#include "server/net/http_door.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/server/net/session_stage.h"

namespace woodlouse::server::http_door_test {

using boost::asio::ip::tcp;

namespace {

namespace asio = boost::asio;

constexpr std::string_view kRequest = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n";
constexpr std::string_view kRooms = "GET /rooms HTTP/1.1\r\nHost: localhost\r\n\r\n";

std::size_t count(std::string_view text, std::string_view part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

struct Browser {
  explicit Browser(const std::string& refusal = {},
                   std::function<void(std::string, HttpDoor::Known)> who = {}) {
    tcp::acceptor acceptor(io, {asio::ip::address_v4::loopback(), 0});
    far.connect(acceptor.local_endpoint());
    door =
        make_http_door(acceptor.accept(), environment, web, {account, refusal},
                       {[this] { ++closed; }, [this](std::unique_ptr<Wire>) { ++upgraded; }, std::move(who)});
    door->start();
    io.poll();
  }
  ~Browser() {
    far.close();
    until([this] { return closed + upgraded == 1; });
    io.poll();
    CHECK(timekeeper.pending() == 0);
  }
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  /// Runs until it is so; what is on its way over the loopback address may take a moment.
  template <typename Condition>
  void until(const Condition& is_so) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!is_so() && std::chrono::steady_clock::now() < end) {
      io.restart();
      io.run_one_for(std::chrono::milliseconds(5));
    }
    CHECK(is_so());
  }
  void until_closed() {
    until([this] { return closed == 1; });
  }
  void say(std::string_view bytes) {
    boost::system::error_code error;  // it may have been closed
    asio::write(far, asio::buffer(bytes), error);
  }
  /// What comes to it: so many answers.
  std::string ask(std::string_view request, std::size_t answers = 1) {
    say(request);
    std::string text;
    until([&] {
      std::string more(far.available(), '\0');
      asio::read(far, asio::buffer(more));
      text += more;
      return count(text, "Server: woodlouse\r\n") == answers;
    });
    io.restart();
    io.poll();
    return text;
  }
  void pass(Duration time) {
    timekeeper.advance(time);
    io.restart();
    io.poll();
  }

  asio::io_context io{1};
  ManualTimekeeper timekeeper;
  protocol::Limits limits;
  LiveLimits live_limits{limits};
  TrafficMetrics traffic;
  FakeDirectory directory{{std::make_shared<FakeDoor>("volcano")}};
  SessionEnvironment environment{directory,  live_limits,       traffic,
                                 timekeeper, "woodlouse a.b.c", std::make_shared<spdlog::logger>("test")};
  WebEnvironment web{{{"lice.example.org"}, {}}, 7777};
  std::shared_ptr<AddressAccount> account =
      std::make_shared<AddressAccount>(7, "127.0.0.1", limits, timekeeper.now());
  tcp::socket far{io};
  std::shared_ptr<HttpDoor> door;
  int closed = 0;
  int upgraded = 0;
};

}  // namespace

TEST_CASE("one request after the other is answered on a socket, also when they come at once") {
  Browser browser;
  CHECK(browser.ask(kRequest).starts_with("HTTP/1.1 200 OK\r\n"));
  const std::string two = browser.ask(std::string(kRequest) + std::string(kRooms), 2);
  CHECK(count(two, "HTTP/1.1 200 OK\r\n") == 2);
  CHECK(two.ends_with("}]\n"));
  CHECK(browser.closed == 0);
}

TEST_CASE("a socket has so many requests, the last of which is told that it is") {
  Browser browser;
  std::string all;
  for (std::uint32_t k = 0; k < HttpDoor::kMostRequests; ++k) {
    CHECK(all.find("Connection: close") == std::string::npos);
    all += browser.ask(kRequest);
  }
  CHECK(count(all, "200 OK") == HttpDoor::kMostRequests);
  CHECK(count(all, "Connection: close") == 1);
  browser.pass(HttpDoor::kLinger);
  browser.until_closed();
}

TEST_CASE("who is slow with a head, or says none, goes after ten seconds without a word") {
  Browser browser;
  const std::string part(GENERATE("", "GET / HTTP/1.1\r\nHost: loc"));
  browser.say(part);
  browser.pass(HttpDoor::kPatience - Duration(1));
  CHECK(browser.closed == 0);
  browser.pass(Duration(1));
  browser.until_closed();
  CHECK(browser.far.available() == 0);
}

TEST_CASE("a head counts from the answer before it") {
  Browser browser;
  browser.pass(HttpDoor::kPatience - Duration(1));
  CHECK(count(browser.ask(kRequest), "200 OK") == 1);
  browser.pass(HttpDoor::kPatience - Duration(1));
  CHECK(count(browser.ask(kRequest), "200 OK") == 1);
}

TEST_CASE("what is no request for a page here is told so, and is the last") {
  const auto [request, status] = GENERATE(table<std::string, std::string>({
      {"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3\r\n\r\nabc", "405 "},
      {"DELETE / HTTP/1.1\r\nHost: localhost\r\n\r\n", "405 "},
      {"GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3\r\n\r\nabc", "413 "},
      {"GET / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n3\r\nabc\r\n0\r\n\r\n",
       "413 "},
      {"GET / HTTP/1.1\r\n\r\n", "400 "},
      {"GET / HTTP/1.1\r\nHost: localhost\r\nHost: localhost\r\n\r\n", "400 "},
      {"GET / HTTP/1.1\r\nHost: evil.example.org\r\n\r\n", "403 "},
      {"GET / HTTP/1.1\r\nHost: localhost\r\nA" + std::string(HttpDoor::kHeadBytes, 'a') + ": b\r\n\r\n",
       "431 "},
      {"GET / HTTP/2.0\r\nHost: localhost\r\n\r\n", "505 "},
      {"GET /\r\n\r\n", "400 "},
      {"GET / HTTP/1.1\r\nHost localhost\r\n\r\n", "400 "},
      {"GET /ws HTTP/1.1\r\nHost: localhost\r\n\r\n", "426 "},
  }));
  INFO(request.substr(0, 80));
  Browser browser;
  const std::string answer = browser.ask(request);
  CHECK(answer.starts_with("HTTP/1.1 " + status));
  CHECK(count(answer, "Connection: close") == 1);
  browser.far.shutdown(tcp::socket::shutdown_send);
  browser.until_closed();
}

TEST_CASE("who looks after the server is told that ticks are overdue, and what was refused is counted") {
  Browser browser;
  browser.directory.are_ticks_overdue = true;
  const std::string answer = browser.ask("GET /readyz HTTP/1.1\r\nHost: localhost\r\n\r\n");
  CHECK(answer.starts_with("HTTP/1.1 503 "));
  CHECK(answer.ends_with("\r\n\r\nticks are overdue\n"));
  CHECK(browser.traffic.web_requests == 1);
  const auto status = std::find(kRefusingStatuses.begin(), kRefusingStatuses.end(), 503u);
  CHECK(browser.traffic.web_refused.at(static_cast<std::size_t>(status - kRefusingStatuses.begin())) == 1);
}

TEST_CASE("HEAD is told how long the page is, and gets none of it") {
  Browser browser;
  const std::string answer = browser.ask("HEAD /healthz HTTP/1.1\r\nHost: lice.example.org:80\r\n\r\n");
  CHECK(answer.starts_with("HTTP/1.1 200 OK\r\n"));
  CHECK(count(answer, "Content-Length: 3\r\n") == 1);
  CHECK(answer.ends_with("\r\n\r\n"));
}

TEST_CASE("an address whose answers took too many bytes waits, but for who looks after the server") {
  Browser browser;
  browser.account->charge(Spending::kAnswerBytes, 1e9, browser.timekeeper.now());
  CHECK(browser.ask(kRequest).starts_with("HTTP/1.1 200 "));
  CHECK(browser.ask(kRooms).starts_with("HTTP/1.1 429 "));
}

TEST_CASE("a socket past its address's share is told so") {
  Browser browser("too many");
  const std::string answer = browser.ask(kRequest);
  CHECK(answer.starts_with("HTTP/1.1 503 "));
  CHECK(answer.ends_with("too many\n"));
}

TEST_CASE("through a proxy each request is another's, who is asked for by all that it says of it") {
  std::vector<std::string> asked;
  const protocol::Limits limits;
  const auto other = std::make_shared<AddressAccount>(8, "192.0.2.1", limits, Time{});
  Browser browser({}, [&](std::string forwarded, const HttpDoor::Known& known) {
    asked.push_back(std::move(forwarded));
    known({other, asked.size() == 3 ? "too many" : ""});
  });
  CHECK(
      browser
          .ask(
              "GET /rooms HTTP/1.1\r\nHost: localhost\r\nX-Forwarded-For: a, b\r\nX-Forwarded-For: c\r\n\r\n")
          .starts_with("HTTP/1.1 200 OK"));
  CHECK(browser.ask(kRooms).starts_with("HTTP/1.1 200 OK"));
  CHECK(browser.account->wait(Spending::kAnswerBytes, browser.timekeeper.now()) == Duration{});
  const std::string last = browser.ask("GET / HTTP/1.1\r\nHost: localhost\r\nx-forwarded-for: d\r\n\r\n");
  CHECK(last.starts_with("HTTP/1.1 503 "));
  CHECK(last.find("too many") != std::string::npos);
  CHECK(asked == std::vector<std::string>{"a, b,c", "", "d"});
}

TEST_CASE("a request of which it is not known yet whose it is waits, and goes with its socket") {
  HttpDoor::Known kept;
  Browser browser({}, [&](const std::string&, HttpDoor::Known known) { kept = std::move(known); });
  browser.say(kRooms);
  browser.until([&] { return static_cast<bool>(kept); });
  CHECK(browser.far.available() == 0);
  browser.pass(HttpDoor::kPatience);
  browser.until_closed();
  kept({browser.account, {}});  // too late
}

TEST_CASE("a WebSocket begins where a page of this server asks for it") {
  const std::string upgrade =
      "GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: keep-alive, Upgrade\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n";
  Browser browser;
  SECTION("its own") {
    const std::string answer = browser.ask(upgrade + "Origin: http://localhost\r\n\r\n");
    CHECK(answer.starts_with("HTTP/1.1 101 "));
    CHECK(count(answer, "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=") == 1);
    browser.until([&] { return browser.upgraded == 1; });
  }
  SECTION("no browser") {
    CHECK(browser.ask(upgrade + "\r\n").starts_with("HTTP/1.1 101 "));
    browser.until([&] { return browser.upgraded == 1; });
  }
  SECTION("another's") {
    CHECK(browser.ask(upgrade + "Origin: http://evil.org\r\n\r\n").starts_with("HTTP/1.1 403 "));
    CHECK(browser.upgraded == 0);
  }
  SECTION("two at once") {
    CHECK(browser.ask(upgrade + "Origin: http://localhost\r\nOrigin: http://evil.org\r\n\r\n")
              .starts_with("HTTP/1.1 403 "));
  }
}

TEST_CASE("the end of the server is the end of a socket on which nothing is answered") {
  Browser browser;
  browser.door->end();
  browser.door->end();
  browser.until_closed();
}

}  // namespace woodlouse::server::http_door_test
