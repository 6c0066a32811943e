#include "server/proxies/trusted_proxies.h"

#include <boost/system/error_code.hpp>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <string>

#include "shared/core/joined.h"

namespace woodlouse::server {
namespace {

namespace ip = boost::asio::ip;

std::optional<ip::address> parse_address(std::string_view text) {
  boost::system::error_code error;
  const ip::address address = ip::make_address(std::string(text), error);
  if (error) return std::nullopt;
  if (address.is_v6() && address.to_v6().is_v4_mapped())
    return ip::make_address_v4(ip::v4_mapped, address.to_v6());
  return address;
}

template <typename Bytes>
bool same_start(const Bytes& one, const Bytes& other, unsigned bits) {
  assert(bits <= 8 * one.size());
  const std::size_t whole = bits / 8;
  if (!std::equal(one.begin(), one.begin() + static_cast<std::ptrdiff_t>(whole), other.begin())) return false;
  const unsigned rest = bits % 8;
  return rest == 0 || (one[whole] ^ other[whole]) >> (8 - rest) == 0;
}

bool lies_in(const ip::address& address, const ProxyNetwork& network) {
  if (address.is_v4() != network.address.is_v4()) return false;
  return address.is_v4()
             ? same_start(address.to_v4().to_bytes(), network.address.to_v4().to_bytes(), network.prefix)
             : same_start(address.to_v6().to_bytes(), network.address.to_v6().to_bytes(), network.prefix);
}

/// An address with or without a port behind it.
std::optional<ip::address> parse_hop(std::string_view text) {
  constexpr std::string_view kBlanks = " \t";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
  if (text.front() == '[') {
    const std::size_t end = text.find(']');
    return end == std::string_view::npos ? std::nullopt : parse_address(text.substr(1, end - 1));
  }
  const std::size_t colon = text.find(':');
  const bool has_port =
      colon != std::string_view::npos && text.find(':', colon + 1) == std::string_view::npos;
  return parse_address(has_port ? text.substr(0, colon) : text);
}

}  // namespace

core::Expected<ProxyNetwork> checked_proxy(std::string_view text) {
  const std::string where = core::joined({"--trusted-proxy ", text});
  constexpr const char* kHint = "for example  --trusted-proxy 10.0.0.7  or  --trusted-proxy fd00:12::/64";
  const std::size_t slash = text.find('/');
  const auto address = parse_address(text.substr(0, slash));
  if (!address) return core::fail(where, "is no address of a proxy", kHint);
  const unsigned most = address->is_v4() ? 32 : 128;
  ProxyNetwork network{*address, most};
  if (slash != std::string_view::npos) {
    const std::string_view digits = text.substr(slash + 1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), network.prefix);
    if (digits.empty() || error != std::errc{} || end != digits.data() + digits.size() ||
        network.prefix > most)
      return core::fail(where, "has no prefix that its address can have", kHint);
    if (network.prefix == 0)
      return core::fail(where, "is everybody, and then each could say that he is another", kHint);
  }
  return network;
}

bool TrustedProxies::contains(const ip::address& address) const {
  const bool is_mapped = address.is_v6() && address.to_v6().is_v4_mapped();
  const ip::address own = is_mapped ? ip::make_address_v4(ip::v4_mapped, address.to_v6()) : address;
  return std::any_of(networks_.begin(), networks_.end(),
                     [&own](const ProxyNetwork& network) { return lies_in(own, network); });
}

std::optional<ip::address> TrustedProxies::behind(std::string_view forwarded) const {
  std::optional<ip::address> found;
  for (;;) {
    const std::size_t comma = forwarded.rfind(',');
    const auto hop = parse_hop(comma == std::string_view::npos ? forwarded : forwarded.substr(comma + 1));
    if (!hop) return found;
    found = hop;
    if (!contains(*hop) || comma == std::string_view::npos) return found;
    forwarded = forwarded.substr(0, comma);
  }
}

}  // namespace woodlouse::server
