// HOST:PORT as people type it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "shared/core/error.h"

namespace woodlouse::client {

struct Address {
  std::string host;
  std::uint16_t port = 7777;

  [[nodiscard]] std::string text() const {
    const bool v6 = host.find(':') != std::string::npos;
    return (v6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
  }
  friend bool operator==(const Address&, const Address&) = default;
};

/// "farm.example:7777", "farm.example", "127.0.0.1:7777", "[::1]:7777", "::1". Error: where = the text; what
/// no look-up could ever find is refused here, a name of nobody's is not.
core::Expected<Address> parse_address(std::string_view text);

}  // namespace woodlouse::client
