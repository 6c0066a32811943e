#include "client/room_list.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <catch2/catch.hpp>

#include <string>
#include <thread>

#include "shared/protocol/codec.h"

namespace woodlouse::client::room_list_test {

namespace {

using boost::asio::ip::tcp;

/// Takes one connection, says `first`, and once a line has come `second`, and closes.
struct Server {
  Server(std::string first, std::string second)
      : acceptor(context, {boost::asio::ip::make_address_v4("127.0.0.1"), 0}),
        thread([this, first = std::move(first), second = std::move(second)] {
          tcp::socket socket = acceptor.accept();
          boost::system::error_code gone;
          boost::asio::write(socket, boost::asio::buffer(first), gone);
          if (second.empty()) return;
          boost::asio::read_until(socket, boost::asio::dynamic_buffer(asked), '\n', gone);
          boost::asio::write(socket, boost::asio::buffer(second), gone);
        }) {}
  ~Server() { thread.join(); }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  [[nodiscard]] Address address() const { return {"127.0.0.1", acceptor.local_endpoint().port()}; }

  boost::asio::io_context context;
  tcp::acceptor acceptor;
  std::string asked;
  std::thread thread;
};

std::string hello() {
  protocol::Hello hello;
  hello.server = "a server";
  hello.session = "0000000000000001";
  hello.rooms = {"volcano"};
  return protocol::encode(hello);
}

}  // namespace

TEST_CASE("rooms stand under each other, with their codes and where they are") {
  const protocol::Rooms rooms{{{"volcano", "volcano", 2, 13, 0, "FKTPZ"},
                               {"hügel/race", "hügel", 1, 0, 5, "BXDRM", "10.0.0.6:7777"},
                               {"old", "hills", 0, 0, 0}}};
  CHECK(table_of(rooms) ==
        "room        map      players  bots  spectators  code   where\n"
        "volcano     volcano        2    13           0  FKTPZ  here\n"
        "hügel/race  hügel          1     0           5  BXDRM  10.0.0.6:7777\n"
        "old         hills          0     0           0         here\n");
}

TEST_CASE("a server is asked for its rooms once it has said hello") {
  const protocol::Rooms told{{{"volcano", "volcano", 2, 3, 0, "FKTPZ"}}};
  std::string asked;
  {
    Server server(hello() + protocol::encode(protocol::ServerMessage(protocol::Ping{1})),
                  protocol::encode(told));
    const auto rooms = ask_for_rooms(server.address());
    REQUIRE(rooms);
    CHECK(*rooms == told);
    server.thread.join();
    server.thread = std::thread([] {});
    asked = server.asked;
  }
  CHECK(asked == protocol::encode(protocol::List{}));
}

TEST_CASE("why there is no list is told, whoever answers") {
  Server refusing(protocol::encode(protocol::ErrorMessage{"banned", "not you", true, {}}), "");
  const auto refused = ask_for_rooms(refusing.address());
  REQUIRE_FALSE(refused);
  CHECK(refused.error().what == "not you");
  Server silent(hello(), "{}\n");
  const auto closed = ask_for_rooms(silent.address());
  REQUIRE_FALSE(closed);
  CHECK(closed.error().where.find("127.0.0.1") != std::string::npos);
  Address nobody{"127.0.0.1", 1};
  CHECK(ask_for_rooms(nobody).error().what == "connection refused");
}

}  // namespace woodlouse::client::room_list_test
