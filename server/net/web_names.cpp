#include "server/net/web_names.h"

#include <boost/asio/ip/address.hpp>
#include <boost/system/error_code.hpp>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <utility>

#include "shared/core/joined.h"

namespace woodlouse::server {
namespace {

constexpr std::size_t kLongestName = 253;

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

bool is_address(const std::string& host) {
  boost::system::error_code error;
  static_cast<void>(boost::asio::ip::make_address(host, error));
  return !error;
}

bool is_name(std::string_view text) {
  const auto may_stand = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '_';
  };
  return !text.empty() && text.size() <= kLongestName && std::all_of(text.begin(), text.end(), may_stand);
}

std::optional<std::uint16_t> parse_port(std::string_view text) {
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return port;
}

constexpr std::uint16_t port_of(bool is_secure) { return is_secure ? 443 : 80; }

}  // namespace

std::optional<Authority> parse_authority(std::string_view text) {
  const bool is_v6 = text.starts_with('[');
  const std::size_t end = is_v6 ? text.find(']') : text.find(':');
  if (is_v6 && end == std::string_view::npos) return std::nullopt;
  Authority authority{lower(is_v6 ? text.substr(1, end - 1) : text.substr(0, end)), std::nullopt};
  const std::string_view rest = end == std::string_view::npos ? "" : text.substr(end + (is_v6 ? 1 : 0));
  if (!rest.empty()) {
    if (!rest.starts_with(':')) return std::nullopt;
    authority.port = parse_port(rest.substr(1));
    if (!authority.port) return std::nullopt;
  }
  const bool is_good = is_v6 ? is_address(authority.host) && authority.host.find(':') != std::string::npos
                             : is_name(authority.host);
  if (!is_good) return std::nullopt;
  return authority;
}

std::optional<Origin> parse_origin(std::string_view text) {
  const std::size_t end = text.find("://");
  if (end == std::string_view::npos) return std::nullopt;
  const std::string scheme = lower(text.substr(0, end));
  if (scheme != "http" && scheme != "https") return std::nullopt;
  auto authority = parse_authority(text.substr(end + 3));
  if (!authority) return std::nullopt;
  const bool is_secure = scheme == "https";
  return Origin{is_secure, std::move(authority->host), authority->port.value_or(port_of(is_secure))};
}

core::Expected<std::string> checked_web_host(std::string_view text) {
  auto authority = parse_authority(text);
  if (!authority || authority->port)
    return core::fail(core::joined({"--web-host ", text}), "is no host's name",
                      "a name alone, for example  --web-host lice.example.org");
  return std::move(authority->host);
}

core::Expected<Origin> checked_web_origin(std::string_view text) {
  auto origin = parse_origin(text);
  if (!origin)
    return core::fail(core::joined({"--web-origin ", text}), "is no origin of a page",
                      "for example  --web-origin https://lice.example.org");
  return std::move(*origin);
}

std::string why_not_host(std::string_view host, const WebNames& names) {
  const auto authority = parse_authority(host);
  if (!authority) return "Host must be a name or an address, and a port where it is another than 80";
  if (authority->host == "localhost" || is_address(authority->host)) return {};
  if (std::find(names.hosts.begin(), names.hosts.end(), authority->host) != names.hosts.end()) return {};
  return "this server does not go by that name: ask it by its address, or start it with --web-host NAME";
}

std::string why_not_origin(std::string_view origin, bool is_secure, std::string_view host,
                           const WebNames& names) {
  const auto asked = parse_authority(host);
  assert(asked.has_value());
  const auto page = parse_origin(origin);
  if (!page) return "a page without an origin of its own may not play here";
  const Origin own{is_secure, asked->host, asked->port.value_or(port_of(is_secure))};
  if (*page == own) return {};
  if (std::find(names.origins.begin(), names.origins.end(), *page) != names.origins.end()) return {};
  return "a page of another origin may not play here, unless the server was started with --web-origin ORIGIN";
}

}  // namespace woodlouse::server
