// A port that is listened on: it takes connections and hands each out on one of the lanes, in turns.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/system/error_code.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "server/net/listen_address.h"
#include "server/room/lanes.h"
#include "server/timing/figures.h"
#include "shared/core/error.h"

namespace woodlouse::server {

class Port {
 public:
  using Strand = boost::asio::strand<boost::asio::io_context::executor_type>;
  /// On the strand. The socket's executor is the lane of that number.
  using Taken = std::function<void(boost::asio::ip::tcp::socket socket, std::size_t lane)>;

  /// lanes and traffic outlive it. option: which one asked for it, for errors.
  Port(const Lanes& lanes, const Strand& strand, std::shared_ptr<spdlog::logger> log, std::string option,
       TrafficMetrics& traffic);

  /// Listens; where that is, with the port that was really taken. Before the threads run.
  core::Expected<boost::asio::ip::tcp::endpoint> open(const ListenAddress& address);

  // On the strand; nothing where it was not opened:
  void start(Taken taken);
  /// Takes no further ones.
  void close();

 private:
  void accept();
  void on_accept(const boost::system::error_code& error, boost::asio::ip::tcp::socket socket,
                 std::size_t lane);
  void pause();

  const Lanes& lanes_;
  std::shared_ptr<spdlog::logger> log_;
  std::string option_;
  TrafficMetrics& traffic_;
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer pause_;
  Taken taken_;
  std::size_t next_lane_ = 0;
  bool starved_ = false;  ///< accepting failed last time; told once
};

}  // namespace woodlouse::server
