#include "client/net/address.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>

namespace woodlouse::client {
namespace {

constexpr std::size_t kLongestName = 253;  ///< of the name system

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whether the system reads it as an address of that family.
bool is_number_of(int family, const std::string& text) {
  assert(family == AF_INET || family == AF_INET6);
  std::array<unsigned char, 16> bytes{};
  return inet_pton(family, text.c_str(), bytes.data()) == 1;
}

/// With or without the zone of a link ("fe80::1%eth0").
bool is_v6(std::string_view host) {
  const std::size_t zone = host.find('%');
  if (zone != std::string_view::npos && zone + 1 == host.size()) return false;
  return is_number_of(AF_INET6, std::string(host.substr(0, zone)));
}

/// What can't be a host without brackets; empty: it may be one.
std::string why_no_name(std::string_view host) {
  if (host.find(':') != std::string_view::npos) return is_v6(host) ? "" : "it is no IPv6 address";
  if (std::all_of(host.begin(), host.end(), is_digit)) return "that is a port without a host";
  const bool is_number =
      std::all_of(host.begin(), host.end(), [](char c) { return is_digit(c) || c == '.'; });
  if (is_number && !is_number_of(AF_INET, std::string(host))) return "it is no IPv4 address";
  // Other letters than ASCII's are left to the look-up.
  const bool is_plain = std::all_of(host.begin(), host.end(), [](char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '.' ||
           c == '_' || static_cast<unsigned char>(c) >= 0x80;
  });
  if (!is_plain) return "a host is made of letters, digits, - and .";
  return host.size() > kLongestName ? "no host has so long a name" : "";
}

}  // namespace

core::Expected<Address> parse_address(std::string_view text) {
  const std::string where = "address \"" + std::string(text) + "\"";
  const char* const hint = "write HOST:PORT, for example localhost:7777 or [::1]:7777";
  if (text.find("://") != std::string_view::npos) return core::fail(where, "it is a link", hint);
  Address address;
  std::string_view port;
  if (!text.empty() && text.front() == '[') {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos) return core::fail(where, "no ] after [", hint);
    address.host = text.substr(1, end - 1);
    if (!is_v6(address.host)) return core::fail(where, "between [ and ] stands no IPv6 address", hint);
    const std::string_view rest = text.substr(end + 1);
    if (!rest.empty() && rest.front() != ':') return core::fail(where, "no : between ] and the port", hint);
    port = rest.empty() ? rest : rest.substr(1);
    if (!rest.empty() && port.empty()) return core::fail(where, "no port after :", hint);
  } else {
    const std::size_t colon = text.rfind(':');
    const bool bare_v6 = colon != std::string_view::npos && text.find(':') != colon;
    if (bare_v6 || colon == std::string_view::npos) {
      address.host = text;
    } else {
      address.host = text.substr(0, colon);
      port = text.substr(colon + 1);
      if (port.empty()) return core::fail(where, "no port after :", hint);
    }
  }
  if (address.host.empty()) return core::fail(where, "no host", hint);
  if (const std::string why = why_no_name(address.host); !why.empty()) return core::fail(where, why, hint);
  if (port.empty()) return address;
  unsigned number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (error != std::errc() || end != port.data() + port.size() || number < 1 || number > 65535) {
    return core::fail(where, "port \"" + std::string(port) + "\" is not a number from 1 to 65535", hint);
  }
  address.port = static_cast<std::uint16_t>(number);
  return address;
}

}  // namespace woodlouse::client
