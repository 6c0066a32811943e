// Addresses that begin alike, as an operator writes them: one, or a network.
#pragma once

#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/address_v6.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace woodlouse::server {

/// Immutable; any thread.
class AddressRange {
 public:
  /// Whoever has one IPv6 address has all of its network: fewer are not told apart, nor are they counted
  /// apart (connection_limits.h).
  static constexpr unsigned kMostBitsV6 = 64;
  // A slip must not shut out half of the world.
  static constexpr unsigned kLeastBitsV4 = 8;
  static constexpr unsigned kLeastBitsV6 = 16;

  enum class Fault { kNoAddress, kBadLength };
  /// 192.0.2.7, 192.0.2.0/24, 2001:db8::1, 2001:db8::/48; what stands behind the length does not count. An
  /// IPv4 address within IPv6 is that IPv4 address. Nothing, and *fault says why, for other texts.
  static std::optional<AddressRange> parse(std::string_view text, Fault* fault = nullptr);
  static AddressRange of(const boost::asio::ip::address& address);

  [[nodiscard]] bool contains(const boost::asio::ip::address& address) const;
  /// Every address of that one is in this one.
  [[nodiscard]] bool contains(const AddressRange& other) const;
  /// In the one way in which it is written back.
  [[nodiscard]] std::string text() const;

  friend bool operator==(const AddressRange&, const AddressRange&) = default;

 private:
  AddressRange(const boost::asio::ip::address_v6& first, unsigned bits, bool is_v4);

  boost::asio::ip::address_v6 first_;  ///< IPv4 within IPv6
  unsigned bits_ = 128;                ///< of those 128
  bool is_v4_ = false;
};

}  // namespace woodlouse::server
