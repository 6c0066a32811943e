#include "server/access/address_range.h"

#include <boost/asio/ip/network_v6.hpp>
#include <boost/system/error_code.hpp>

#include <algorithm>
#include <cassert>
#include <charconv>

#include "shared/core/joined.h"

namespace woodlouse::server {
namespace {

namespace ip = boost::asio::ip;

constexpr unsigned kV4Bits = 96;  // before an IPv4 address within IPv6

ip::address_v6 within_v6(const ip::address& address) {
  if (address.is_v4()) return ip::make_address_v6(ip::v4_mapped, address.to_v4());
  // By which of this machine's networks it came is no part of whose it is.
  ip::address_v6 v6 = address.to_v6();
  v6.scope_id(0);
  return v6;
}

}  // namespace

AddressRange::AddressRange(const ip::address_v6& first, unsigned bits, bool is_v4)
    : first_(ip::network_v6(first, static_cast<unsigned short>(bits)).network()), bits_(bits), is_v4_(is_v4) {
  assert(bits <= 128 && (!is_v4 || bits >= kV4Bits));
}

AddressRange AddressRange::of(const ip::address& address) {
  const ip::address_v6 v6 = within_v6(address);
  const bool is_v4 = v6.is_v4_mapped();
  return {v6, is_v4 ? 128 : kMostBitsV6, is_v4};
}

std::optional<AddressRange> AddressRange::parse(std::string_view text, Fault* fault) {
  if (fault != nullptr) *fault = Fault::kNoAddress;
  const std::size_t slash = text.find('/');
  boost::system::error_code error;
  const ip::address address = ip::make_address(std::string(text.substr(0, slash)), error);
  if (error) return std::nullopt;
  const AddressRange one = of(address);
  if (slash == std::string_view::npos) return one;
  const std::string_view digits = text.substr(slash + 1);
  unsigned bits = 0;
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), bits);
  const bool is_v4_text = address.is_v4();
  if (fault != nullptr) *fault = Fault::kBadLength;
  if (status != std::errc() || end != digits.data() + digits.size() || bits > (is_v4_text ? 32u : 128u))
    return std::nullopt;
  if (is_v4_text) bits += kV4Bits;
  if (one.is_v4_ ? bits < kV4Bits + kLeastBitsV4 : bits < kLeastBitsV6) return std::nullopt;
  return AddressRange(within_v6(address), one.is_v4_ ? bits : std::min(bits, kMostBitsV6), one.is_v4_);
}

bool AddressRange::contains(const ip::address& address) const { return contains(of(address)); }

bool AddressRange::contains(const AddressRange& other) const {
  if (is_v4_ != other.is_v4_ || other.bits_ < bits_) return false;
  return ip::network_v6(other.first_, static_cast<unsigned short>(bits_)).network() == first_;
}

std::string AddressRange::text() const {
  const std::string first =
      is_v4_ ? ip::make_address_v4(ip::v4_mapped, first_).to_string() : first_.to_string();
  const unsigned bits = is_v4_ ? bits_ - kV4Bits : bits_;
  if (is_v4_ && bits == 32) return first;
  return core::joined({first, "/", std::to_string(bits)});
}

}  // namespace woodlouse::server
