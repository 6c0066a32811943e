#include "server/net/connection_limits.h"

#include <boost/asio/ip/network_v6.hpp>

#include <cassert>

namespace woodlouse::server {

namespace ip = boost::asio::ip;

ConnectionLimits::Admission ConnectionLimits::admit(const std::string& key) {
  std::uint32_t& count = counts_[key];
  if (count >= per_address_ + kCourtesy) return Admission::kDrop;
  return ++count > per_address_ ? Admission::kRefuse : Admission::kWelcome;
}

void ConnectionLimits::release(const std::string& key) {
  const auto found = counts_.find(key);
  assert(found != counts_.end());
  if (--found->second == 0) counts_.erase(found);
}

std::string ConnectionLimits::key(const ip::address& address) {
  if (address.is_v4()) return address.to_string();
  const ip::address_v6 v6 = address.to_v6();
  if (v6.is_v4_mapped()) return ip::make_address_v4(ip::v4_mapped, v6).to_string();
  return ip::make_network_v6(v6, 64).canonical().to_string();
}

}  // namespace woodlouse::server
