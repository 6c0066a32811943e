#include "server/net/doorway.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <catch2/catch.hpp>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "tests/server/timing/manual_timekeeper.h"

namespace woodlouse::server::doorway_test {

namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

/// A doorway, who stands in it, and a clock.
struct Porch {
  Porch() {
    tcp::acceptor acceptor(io, {asio::ip::address_v4::loopback(), 0});
    far.connect(acceptor.local_endpoint());
    doorway = std::make_shared<Doorway>(acceptor.accept(), timekeeper);
    doorway->start([this](Comes what, tcp::socket socket) {
      CHECK_FALSE(came.has_value());
      came = what;
      near.emplace(std::move(socket));
    });
    io.poll();
  }
  void say(std::string_view bytes) {
    asio::write(far, asio::buffer(bytes));
    run();
  }
  void run() {
    io.restart();
    io.run();
  }
  /// Whether the server has closed it without a word.
  [[nodiscard]] bool far_is_at_its_end() {
    char byte = 0;
    boost::system::error_code error;
    const std::size_t size = far.read_some(asio::buffer(&byte, 1), error);
    return size == 0 && error == asio::error::eof;
  }

  asio::io_context io{1};
  ManualTimekeeper timekeeper;
  tcp::socket far{io};
  std::shared_ptr<Doorway> doorway;
  std::optional<Comes> came;
  std::optional<tcp::socket> near;
};

}  // namespace

TEST_CASE("the first byte tells what somebody speaks") {
  for (int byte = 0; byte < 256; ++byte) {
    Comes wanted = Comes::kNothing;
    if (std::string_view("{ \t\r\n").find(static_cast<char>(byte)) != std::string_view::npos)
      wanted = Comes::kLines;
    if (byte >= 'A' && byte <= 'Z') wanted = Comes::kHttp;
    if (byte == 0x16) wanted = Comes::kTls;
    INFO(byte);
    CHECK(what_comes(static_cast<unsigned char>(byte)) == wanted);
  }
}

TEST_CASE("who takes over at a doorway reads the first byte, too") {
  Porch porch;
  CHECK_FALSE(porch.came.has_value());
  porch.say("{\"type\"");
  REQUIRE(porch.came == Comes::kLines);
  std::string read(7, '?');
  asio::read(*porch.near, asio::buffer(read));
  CHECK(read == "{\"type\"");
  CHECK(porch.timekeeper.pending() == 0);
}

TEST_CASE("who says nothing at a doorway for ten seconds is sent away without a word") {
  Porch porch;
  porch.timekeeper.advance(Doorway::kPatience - Duration(1));
  porch.io.poll();
  CHECK_FALSE(porch.came.has_value());
  porch.timekeeper.advance(Duration(1));
  porch.run();
  CHECK(porch.came == Comes::kNothing);
  CHECK(porch.far_is_at_its_end());
}

TEST_CASE("what nobody speaks at a doorway is closed, as is who goes, and who is still there at the end") {
  SECTION("an unknown first byte") {
    Porch porch;
    porch.say(std::string_view("\0", 1));
    CHECK(porch.came == Comes::kNothing);
  }
  SECTION("gone") {
    Porch porch;
    porch.far.close();
    porch.run();
    CHECK(porch.came == Comes::kNothing);
  }
  SECTION("the end") {
    Porch porch;
    porch.doorway->end();
    porch.doorway->end();
    porch.run();
    CHECK(porch.came == Comes::kNothing);
    CHECK(porch.far_is_at_its_end());
    CHECK(porch.timekeeper.pending() == 0);
  }
}

}  // namespace woodlouse::server::doorway_test
