#include "server/net/listen_address.h"

#include <charconv>

#include "shared/core/joined.h"

namespace woodlouse::server {
namespace {

core::Expected<std::uint16_t> parse_port(std::string_view text, const std::string& where) {
  unsigned value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size() || value > 65535)
    return core::fail(where, core::joined({"\"", text, "\" is no port"}),
                      "a number from 0 (any free one) to 65535");
  return static_cast<std::uint16_t>(value);
}

}  // namespace

core::Expected<ListenAddress> parse_listen_address(std::string_view text, std::string_view option,
                                                   std::uint16_t default_port) {
  ListenAddress address;
  address.port = default_port;
  const std::string where = core::joined({option, " ", text});
  std::string_view host = text;
  std::string_view port;
  bool has_port = false;
  if (text.starts_with('[')) {
    const std::size_t end = text.find(']');
    const std::string_view rest = end == std::string_view::npos ? "?" : text.substr(end + 1);
    if (!rest.empty() && !rest.starts_with(':'))
      return core::fail(where, "is no [IPV6]:PORT", "for example [::1]:7777");
    host = text.substr(1, end - 1);
    has_port = !rest.empty();
    port = rest.substr(has_port ? 1 : 0);
  } else if (const std::size_t colon = text.rfind(':'); colon != std::string_view::npos) {
    if (text.find(':') != colon)
      return core::fail(where, "an IPv6 address needs brackets", "for example [::1]:7777");
    host = text.substr(0, colon);
    port = text.substr(colon + 1);
    has_port = true;
  }
  if (has_port) {
    const auto number = parse_port(port, where);
    if (!number) return tl::unexpected(number.error());
    address.port = *number;
  }
  address.host = host.empty() ? "0.0.0.0" : std::string(host);
  return address;
}

std::string to_text(const ListenAddress& address) {
  const bool is_v6 = address.host.find(':') != std::string::npos;
  return (is_v6 ? '[' + address.host + ']' : address.host) + ':' + std::to_string(address.port);
}

std::string to_text(const boost::asio::ip::tcp::endpoint& endpoint) {
  return to_text(ListenAddress{endpoint.address().to_string(), endpoint.port()});
}

boost::asio::ip::tcp::endpoint reachable(const boost::asio::ip::tcp::endpoint& endpoint) {
  using namespace boost::asio::ip;
  if (!endpoint.address().is_unspecified()) return endpoint;
  const bool is_v6 = endpoint.address().is_v6();
  return {is_v6 ? address(address_v6::loopback()) : address(address_v4::loopback()), endpoint.port()};
}

}  // namespace woodlouse::server
