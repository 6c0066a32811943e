// The socket that the admin door listens on.
//
// A Unix socket has mode 0600 before anybody can connect to it. One that a server left behind which was
// killed is replaced, one behind which a server lives is not, nor is what is no socket. It is removed at the
// end, unless another one stands in its place by then.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/basic_socket_acceptor.hpp>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "server/admin/admin_address.h"
#include "shared/core/error.h"

namespace woodlouse::server {

class AdminPort {
 public:
  using Strand = boost::asio::strand<boost::asio::io_context::executor_type>;
  using Socket = boost::asio::generic::stream_protocol::socket;

  AdminPort(Strand strand, std::shared_ptr<spdlog::logger> log);
  AdminPort(const AdminPort&) = delete;
  AdminPort& operator=(const AdminPort&) = delete;
  /// Removes the socket.
  ~AdminPort() { remove(); }

  /// Listens; where that is, with the port that was really taken. Before the threads run.
  core::Expected<std::string> open(const AdminAddress& address);

  // On the strand:
  void start(std::function<void(Socket)> taken);
  void close();

 private:
  core::Expected<std::string> open_socket(const std::filesystem::path& path);
  core::Expected<std::string> open_port(const ListenAddress& address);
  void accept();
  void pause();
  void remove();

  Strand strand_;
  std::shared_ptr<spdlog::logger> log_;
  boost::asio::basic_socket_acceptor<boost::asio::generic::stream_protocol> acceptor_;
  boost::asio::steady_timer pause_;
  std::function<void(Socket)> taken_;
  std::filesystem::path path_;  ///< absolute, of the socket that is to be removed; empty: there is none
  std::uint64_t device_ = 0, inode_ = 0;
  bool is_starved_ = false;  ///< accepting failed last time; told once
};

}  // namespace woodlouse::server
