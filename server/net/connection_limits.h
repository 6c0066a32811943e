// How many connections there are, and of which address. An IPv6 client owns a /64, so that is what counts as
// its address. Pure. One owner, no locking.
#pragma once

#include <boost/asio/ip/address.hpp>

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>

#include "server/net/address_account.h"
#include "server/timing/live_limits.h"

namespace woodlouse::server {

class ConnectionLimits {
 public:
  /// Past a limit so many more are told why before they are turned away; further ones are just closed.
  static constexpr std::uint32_t kCourtesy = 16;
  /// One connection in so many is for addresses that have none: a few can't keep out everybody else.
  static constexpr std::uint32_t kReserve = 20;
  /// So many of an address's connections may speak HTTP: six are what a browser opens for a page, and some
  /// twenty behind one router may come at once. A page that lacks a module does not begin.
  static constexpr std::uint32_t kMostHttp = 128;

  /// limits outlives it.
  explicit ConnectionLimits(const LiveLimits& limits) : limits_(limits) {}

  enum class Admission { kWelcome, kAddressFull, kServerFull, kDrop };
  /// A connection of that address: all but kDrop count it until release().
  Admission admit(const std::string& key, Time now);
  /// The same of a trusted proxy's, of which it is not known yet whose it is: the server's own limit alone
  /// counts, and a key of its own.
  Admission admit_unknown(const std::string& key, Time now);
  void release(const std::string& key, Time now);
  /// Whether one of its connections may speak HTTP; then it counts as such until give_http_back(). REQUIRES
  /// that it was admitted and not released.
  [[nodiscard]] bool take_http(const std::string& key);
  void give_http_back(const std::string& key);
  /// REQUIRES that it was admitted and not released. It outlives the address's connections while there is
  /// something to remember: who comes back finds it as he left it.
  [[nodiscard]] const std::shared_ptr<AddressAccount>& account(const std::string& key) const {
    return addresses_.at(key).account;
  }
  [[nodiscard]] std::size_t addresses() const { return addresses_.size(); }

  /// What connections are counted by: the IPv4 address (also a mapped one), or the IPv6 network.
  static std::string key(const boost::asio::ip::address& address);

 private:
  struct Address {
    std::uint32_t connections = 0;
    std::uint32_t http = 0;  ///< of them
    std::shared_ptr<AddressAccount> account;
    bool is_leaving = false;  ///< stands in leaving_
  };
  void count(const std::string& key, Time now);
  void forget_some(Time now);

  const LiveLimits& limits_;
  std::map<std::string, Address> addresses_;
  std::deque<std::string> leaving_;  ///< without a connection, to be forgotten once they are at rest
  std::uint32_t connections_ = 0;
  AddressId next_id_ = 1;
};

}  // namespace woodlouse::server
