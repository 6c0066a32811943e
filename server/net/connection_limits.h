// How many connections each address has. An IPv6 client owns a /64, so that is what counts as its address.
// Pure. One owner, no locking.
#pragma once

#include <boost/asio/ip/address.hpp>

#include <cstdint>
#include <map>
#include <string>

namespace woodlouse::server {

class ConnectionLimits {
 public:
  /// Past the limit so many more are told why before they are turned away; further ones are just closed.
  static constexpr std::uint32_t kCourtesy = 16;

  explicit ConnectionLimits(std::uint32_t per_address) : per_address_(per_address) {}

  enum class Admission { kWelcome, kRefuse, kDrop };
  /// A connection of that address: kWelcome and kRefuse count it until release().
  Admission admit(const std::string& key);
  void release(const std::string& key);

  /// What connections are counted by: the IPv4 address (also a mapped one), or the IPv6 network.
  static std::string key(const boost::asio::ip::address& address);

 private:
  std::uint32_t per_address_;
  std::map<std::string, std::uint32_t> counts_;
};

}  // namespace woodlouse::server
