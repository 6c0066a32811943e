// The PROXY protocol, version 2 (haproxy's proxy-protocol.txt): what a proxy says before anything else of
// whose connection it passes on. Pure: bytes in, a verdict out.
//
//     \r\n\r\n\0\r\nQUIT\n   version and command   family   length (two bytes, of what follows)   addresses
//     TLVs
#pragma once

#include <boost/asio/ip/address.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace woodlouse::server {

/// Of the bytes that have come so far.
struct ProxyHeader {
  /// Longer ones are refused: it is looked at whole. Addresses are 36 bytes at most, the rest are TLVs.
  static constexpr std::size_t kMostBytes = 4096;

  enum class Verdict : std::uint8_t {
    kMore,     ///< may become a header
    kNone,     ///< is none, and nothing was taken
    kRefused,  ///< is one that can't be used
    kWhole,
  };
  Verdict verdict = Verdict::kNone;
  std::size_t bytes = 0;  ///< of a whole one its length; where more must come, how many are wanted at least
  /// For whom the connection is. Nothing: for the proxy itself (LOCAL, as its health checks are), or for
  /// somebody who has no address (a Unix socket).
  std::optional<boost::asio::ip::address> source{};
  std::string why{};  ///< it is refused, and what to do about it

  /// `bytes`: from the connection's first on.
  [[nodiscard]] static ProxyHeader read(std::string_view bytes);
};

}  // namespace woodlouse::server
