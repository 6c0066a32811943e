// Servers of the test's own on the client's io_context, which do what a test says at each join.
#pragma once

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/streambuf.hpp>
#include <boost/asio/write.hpp>
#include <catch2/catch.hpp>
#include <functional>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/net/connection.h"
#include "shared/protocol/codec.h"

namespace woodlouse::client {

inline std::string welcome(bool resumed) {
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

/// Answers the n-th join with the n-th text, and ends the connection where that text ends without a bye.
/// Further joins are answered as the last one.
class Host {
 public:
  explicit Host(boost::asio::io_context& context, std::vector<std::string> answers = {})
      : context_(context),
        acceptor_(context, Tcp::endpoint(boost::asio::ip::address_v4::loopback(), 0)),
        answers_(std::move(answers)) {
    accept();
  }
  void will_answer(std::vector<std::string> answers) { answers_ = std::move(answers); }
  /// What hello names from now on.
  void name(std::vector<std::string> hosts) { hello_.hosts = std::move(hosts); }
  /// Takes no connection any more.
  void close() { acceptor_.close(); }
  [[nodiscard]] const Address& address() const { return address_; }
  [[nodiscard]] const std::vector<std::string>& joins() const { return joins_; }

 private:
  using Tcp = boost::asio::ip::tcp;
  struct Guest {
    explicit Guest(boost::asio::io_context& context) : socket(context) {}
    Tcp::socket socket;
    boost::asio::streambuf bytes;
  };

  void accept() {
    auto guest = std::make_shared<Guest>(context_);
    acceptor_.async_accept(guest->socket, [this, guest](boost::system::error_code error) {
      if (error) return;
      accept();
      boost::asio::write(guest->socket,
                         boost::asio::buffer(protocol::encode(protocol::ServerMessage(hello_))));
      boost::asio::async_read_until(guest->socket, guest->bytes, '\n',
                                    [this, guest](boost::system::error_code failed, std::size_t) {
                                      if (!failed) on_join(*guest);
                                    });
    });
  }
  void on_join(Guest& guest) {
    std::istream lines(&guest.bytes);
    std::getline(lines, joins_.emplace_back());
    const std::string& answer = answers_.at(std::min(joins_.size(), answers_.size()) - 1);
    boost::system::error_code gone;  // who is sent on does not wait for the end
    boost::asio::write(guest.socket, boost::asio::buffer(answer), gone);
    guest.socket.shutdown(Tcp::socket::shutdown_send, gone);
  }

  boost::asio::io_context& context_;
  Tcp::acceptor acceptor_;
  Address address_{"127.0.0.1", acceptor_.local_endpoint().port()};
  protocol::Hello hello_;
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

/// The client's join: with fields, and a louse that is to wait.
inline protocol::Join join_of_ann() {
  protocol::Join join;
  join.name = "ann";
  join.fields = protocol::default_columns();
  join.may_resume = true;
  return join;
}

inline std::string bye(const char* code, const std::string& address = {}) {
  return protocol::encode(
      protocol::ServerMessage(protocol::Bye{code, "so it is", !address.empty(), address}));
}

}  // namespace woodlouse::client
