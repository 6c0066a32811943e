// Where to listen: `HOST:PORT` as people write it.
#pragma once

#include <boost/asio/ip/tcp.hpp>

#include <cstdint>
#include <string>
#include <string_view>

#include "shared/core/error.h"

namespace woodlouse::server {

inline constexpr std::uint16_t kDefaultPort = 7777;
inline constexpr std::uint16_t kDefaultWebPort = 7778;

struct ListenAddress {
  std::string host = "127.0.0.1";     ///< a name or an address, IPv6 without brackets
  std::uint16_t port = kDefaultPort;  ///< 0: any free one
  friend bool operator==(const ListenAddress&, const ListenAddress&) = default;
};

/// HOST, HOST:PORT, :PORT (every IPv4 address), [IPV6]:PORT. option: which one says so, for errors. port:
/// where none is named.
core::Expected<ListenAddress> parse_listen_address(std::string_view text,
                                                   std::string_view option = "--listen",
                                                   std::uint16_t port = kDefaultPort);

/// `host:port`, `[host]:port` for IPv6.
std::string to_text(const ListenAddress& address);
std::string to_text(const boost::asio::ip::tcp::endpoint& endpoint);
/// Where a browser on this machine finds what listens there: at an address, where it listens at every one.
boost::asio::ip::tcp::endpoint reachable(const boost::asio::ip::tcp::endpoint& endpoint);

}  // namespace woodlouse::server
