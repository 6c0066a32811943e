#include "server/net/tcp_wire.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <catch2/catch.hpp>

#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace woodlouse::server::tcp_wire_test {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

/// A wire, and the socket at its other end, over the loopback address.
struct Pair {
  Pair() {
    tcp::acceptor acceptor(io, {asio::ip::address_v4::loopback(), 0});
    far.connect(acceptor.local_endpoint());
    tcp::socket near = acceptor.accept();
    options_error = set_options(near, std::chrono::seconds(15));
    wire = std::make_unique<TcpWire>(std::move(near));
  }
  void run() {
    io.restart();
    io.run();
  }

  asio::io_context io{1};
  tcp::socket far{io};
  error_code options_error;
  std::unique_ptr<TcpWire> wire;
};

/// What a handler was called with.
struct Outcome {
  int calls = 0;
  error_code error;
  std::size_t size = 0;
  Wire::Handler handler() {
    return [this](const error_code& how, std::size_t bytes) { ++calls, error = how, size = bytes; };
  }
};

Line line(const std::string& text) { return Line(text); }

}  // namespace

TEST_CASE("a wire over TCP carries lines in their order, then its end") {
  Pair pair;
  CHECK_FALSE(pair.options_error);
  const std::vector<Line> lines{line("one\n"), line("two\n"), line("three\n")};
  Outcome written;
  pair.wire->write(lines, 0, written.handler());
  CHECK(written.calls == 0);
  pair.run();
  CHECK(written.calls == 1);
  CHECK_FALSE(written.error);
  CHECK(written.size == 14);
  CHECK_FALSE(pair.wire->shut_down_sending());
  std::string got;
  error_code error;
  asio::read(pair.far, asio::dynamic_buffer(got), error);
  CHECK(got == "one\ntwo\nthree\n");
  CHECK(error == asio::error::eof);
}

TEST_CASE("a wire over TCP reads what there is, then the other side's end") {
  Pair pair;
  std::array<char, 100> into{};
  asio::write(pair.far, asio::buffer("hello", 5));
  Outcome read;
  pair.wire->read_some(into, read.handler());
  pair.run();
  CHECK_FALSE(read.error);
  CHECK(std::string(into.data(), read.size) == "hello");
  pair.far.close();
  pair.wire->read_some(into, read.handler());
  pair.run();
  CHECK(read.error == asio::error::eof);
}

TEST_CASE("closing a wire over TCP ends its read, afterwards every call fails") {
  Pair pair;
  std::array<char, 100> into{};
  Outcome read;
  pair.wire->read_some(into, read.handler());
  CHECK_FALSE(pair.wire->close());
  pair.run();
  CHECK(read.calls == 1);
  CHECK(read.error == asio::error::operation_aborted);
  const std::vector<Line> lines{line("late\n")};
  Outcome written;
  pair.wire->write(lines, 0, written.handler());
  pair.run();
  CHECK(written.error);
  tcp::socket unconnected(pair.io);
  CHECK(set_options(unconnected, std::chrono::seconds(15)));
  CHECK(pair.wire->shut_down_sending());
}

}  // namespace woodlouse::server::tcp_wire_test
