#include "server/net/connection_limits.h"

#include <boost/asio/ip/network_v6.hpp>

#include <cassert>
#include <utility>

namespace woodlouse::server {

namespace ip = boost::asio::ip;

ConnectionLimits::Admission ConnectionLimits::admit(const std::string& key, Time now) {
  forget_some(now);
  const auto limits = limits_.now();
  const auto found = addresses_.find(key);
  const std::uint32_t own = found == addresses_.end() ? 0 : found->second.connections;
  const std::uint32_t reserved = own > 0 ? limits->max_connections / kReserve : 0;
  Admission admission = Admission::kWelcome;
  if (own >= limits->per_address) admission = Admission::kAddressFull;
  if (connections_ >= limits->max_connections - reserved) admission = Admission::kServerFull;
  if (own >= limits->per_address + kCourtesy || connections_ >= limits->max_connections + kCourtesy)
    return Admission::kDrop;
  count(key, now);
  return admission;
}

ConnectionLimits::Admission ConnectionLimits::admit_unknown(const std::string& key, Time now) {
  forget_some(now);
  const std::uint32_t most = limits_.now()->max_connections;
  if (connections_ >= most + kCourtesy) return Admission::kDrop;
  const Admission admission = connections_ >= most ? Admission::kServerFull : Admission::kWelcome;
  count(key, now);
  return admission;
}

void ConnectionLimits::count(const std::string& key, Time now) {
  Address& address = addresses_[key];
  if (address.account == nullptr)
    address.account = std::make_shared<AddressAccount>(next_id_++, key, *limits_.now(), now);
  ++address.connections;
  ++connections_;
}

void ConnectionLimits::release(const std::string& key, Time now) {
  const auto found = addresses_.find(key);
  assert(found != addresses_.end() && found->second.connections > 0 && connections_ > 0);
  --connections_;
  if (--found->second.connections > 0) return;
  if (!std::exchange(found->second.is_leaving, true)) leaving_.push_back(key);
  forget_some(now);
}

bool ConnectionLimits::take_http(const std::string& key) {
  Address& address = addresses_.at(key);
  assert(address.connections > address.http);
  if (address.http >= kMostHttp) return false;
  ++address.http;
  return true;
}

void ConnectionLimits::give_http_back(const std::string& key) {
  Address& address = addresses_.at(key);
  assert(address.http > 0 && address.connections >= address.http);
  --address.http;
}

/// Two for each that comes: those that left are soon all looked at.
void ConnectionLimits::forget_some(Time now) {
  for (int k = 0; k < 2 && !leaving_.empty(); ++k) {
    const std::string key = std::move(leaving_.front());
    leaving_.pop_front();
    const auto found = addresses_.find(key);
    assert(found != addresses_.end());
    found->second.is_leaving = false;
    if (found->second.connections > 0) continue;
    if (found->second.account->is_at_rest(now)) {
      addresses_.erase(found);
    } else {
      found->second.is_leaving = true;
      leaving_.push_back(key);
    }
  }
}

std::string ConnectionLimits::key(const ip::address& address) {
  if (address.is_v4()) return address.to_string();
  const ip::address_v6 v6 = address.to_v6();
  if (v6.is_v4_mapped()) return ip::make_address_v4(ip::v4_mapped, v6).to_string();
  return ip::make_network_v6(v6, 64).canonical().to_string();
}

}  // namespace woodlouse::server
