#include "server/net/tls_doorway.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/write.hpp>
#include <catch2/catch.hpp>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "server/net/tls_context.h"
#include "server/net/tls_wire.h"
#include "tests/server/timing/manual_timekeeper.h"

namespace woodlouse::server::tls_doorway_test {

namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

/// A doorway of TLS and who stands in it, with a clock that stands still.
struct Porch {
  Porch() {
    const std::string folder = std::string(WOODLOUSE_SOURCE_DIR) + "/tests/tls/";
    context = load_tls({folder + "first_certificate.pem", folder + "first_key.pem"}).value();
    tcp::acceptor acceptor(io, {asio::ip::address_v4::loopback(), 0});
    far.connect(acceptor.local_endpoint());
    doorway = make_tls_doorway(acceptor.accept(), *context, timekeeper);
    doorway->start([this](Comes what, std::unique_ptr<TlsConnection> connection) {
      CHECK_FALSE(came.has_value());
      CHECK((connection == nullptr) == (what == Comes::kNothing));
      came = what;
    });
    io.poll();
  }
  ~Porch() { CHECK(timekeeper.pending() == 0); }
  Porch(const Porch&) = delete;
  Porch& operator=(const Porch&) = delete;

  void say(std::string_view bytes) {
    asio::write(far, asio::buffer(bytes));
    io.restart();
    io.run_for(std::chrono::milliseconds(20));
  }
  void run() {
    io.restart();
    io.run();
  }

  asio::io_context io{1};
  ManualTimekeeper timekeeper;
  std::shared_ptr<asio::ssl::context> context;
  tcp::socket far{io};
  std::shared_ptr<TlsDoorway> doorway;
  std::optional<Comes> came;
};

}  // namespace

TEST_CASE("half a handshake of TLS has ten seconds, and a stopping server waits for none") {
  Porch porch;
  porch.say(std::string_view("\x16\x03\x01\x02\x00\x01", 6));
  CHECK_FALSE(porch.came.has_value());
  SECTION("the time") { porch.timekeeper.advance(Doorway::kPatience); }
  SECTION("the end") { porch.doorway->end(); }
  SECTION("gone") { porch.far.close(); }
  porch.run();
  CHECK(porch.came == Comes::kNothing);
}

TEST_CASE("what only begins as TLS is closed") {
  Porch porch;
  porch.say(std::string("\x16garbage that is no handshake at all") + std::string(100, '\0'));
  porch.run();
  CHECK(porch.came == Comes::kNothing);
}

}  // namespace woodlouse::server::tls_doorway_test
