// Which proxies are believed when they say whose connection or request they pass on. Pure.
#pragma once

#include <boost/asio/ip/address.hpp>

#include <optional>
#include <string_view>
#include <vector>

#include "shared/core/error.h"

namespace woodlouse::server {

/// An address, or a network of them.
struct ProxyNetwork {
  boost::asio::ip::address address;  ///< no IPv4 address that is mapped into IPv6
  unsigned prefix = 0;               ///< bits that count, 1 to 32 or 128
};

/// ADDRESS or ADDRESS/PREFIX, as typed. Errors: where = the option.
[[nodiscard]] core::Expected<ProxyNetwork> checked_proxy(std::string_view text);

class TrustedProxies {
 public:
  TrustedProxies() = default;  ///< nobody
  explicit TrustedProxies(std::vector<ProxyNetwork> networks) : networks_(std::move(networks)) {}

  [[nodiscard]] bool contains(const boost::asio::ip::address& address) const;

  /// Whom a request is for: of the list that its X-Forwarded-For are, joined by commas, the last one that is
  /// no trusted proxy; the first, where all are. What stands left of it anybody may have written. Nothing:
  /// there is none, or it is no address.
  [[nodiscard]] std::optional<boost::asio::ip::address> behind(std::string_view forwarded) const;

 private:
  std::vector<ProxyNetwork> networks_;
};

}  // namespace woodlouse::server
