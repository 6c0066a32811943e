#include "client/net/address.h"

#include <charconv>

namespace woodlouse::client {

core::Expected<Address> parse_address(std::string_view text) {
  const std::string where = "address \"" + std::string(text) + "\"";
  const char* const hint = "write HOST:PORT, for example localhost:7777 or [::1]:7777";
  Address address;
  std::string_view port;
  if (!text.empty() && text.front() == '[') {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos) return core::fail(where, "no ] after [", hint);
    address.host = text.substr(1, end - 1);
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
