#include "server/proxies/proxy_header.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace woodlouse::server {

using Verdict = ProxyHeader::Verdict;

namespace {

namespace ip = boost::asio::ip;

constexpr std::string_view kSignature("\r\n\r\n\0\r\nQUIT\n", 12);
constexpr std::string_view kFirstVersion = "PROXY ";
constexpr std::size_t kStart = 16;  // signature, version and command, family, length
constexpr std::size_t kTlvStart = 3;

unsigned byte_at(std::string_view bytes, std::size_t at) {
  assert(at < bytes.size());
  return static_cast<unsigned char>(bytes[at]);
}

std::size_t length_at(std::string_view bytes, std::size_t at) {
  return byte_at(bytes, at) << 8 | byte_at(bytes, at + 1);
}

/// One begins as the other.
bool begins_as(std::string_view one, std::string_view other) {
  const std::size_t both = std::min(one.size(), other.size());
  return one.substr(0, both) == other.substr(0, both);
}

ProxyHeader more(std::size_t bytes) { return {Verdict::kMore, bytes}; }

ProxyHeader refused(std::string why) { return {Verdict::kRefused, 0, std::nullopt, std::move(why)}; }

template <typename Address>
Address address_at(std::string_view bytes, std::size_t at) {
  typename Address::bytes_type address{};
  for (std::size_t k = 0; k < address.size(); ++k)
    address[k] = static_cast<unsigned char>(byte_at(bytes, at + k));
  return Address(address);
}

/// What stands behind the addresses is passed over, but has to be what it should be.
bool are_tlvs(std::string_view bytes) {
  while (bytes.size() >= kTlvStart) {
    const std::size_t size = kTlvStart + length_at(bytes, 1);
    if (size > bytes.size()) return false;
    bytes.remove_prefix(size);
  }
  return bytes.empty();
}

/// Two addresses and two ports, by the family's number; nothing: no family that may stand there.
std::optional<std::size_t> addresses_of(unsigned family) {
  switch (family) {
    case 0x00:  // unspecified
      return 0;
    case 0x11:  // TCP over IPv4
      return 12;
    case 0x21:  // TCP over IPv6
      return 36;
    case 0x31:  // a Unix socket's stream
      return 216;
    default:
      return std::nullopt;
  }
}

/// It is there whole.
ProxyHeader read_whole(std::string_view bytes) {
  constexpr unsigned kLocal = 0x20, kProxy = 0x21, kIPv4 = 0x11, kIPv6 = 0x21;
  ProxyHeader header{Verdict::kWhole, bytes.size()};
  const unsigned command = byte_at(bytes, 12);
  const unsigned family = byte_at(bytes, 13);
  if (command >> 4 != 2) return refused("its version is not 2");
  if (command == kLocal) return header;  // the rest is to be passed over, whatever it is
  if (command != kProxy) return refused("its command is neither LOCAL nor PROXY");
  const auto addresses = addresses_of(family);
  if (!addresses) return refused("its family is neither TCP nor a Unix socket's");
  if (bytes.size() < kStart + *addresses) return refused("it is too short for the addresses of its family");
  if (family != 0 && !are_tlvs(bytes.substr(kStart + *addresses))) return refused("its TLVs are not whole");
  if (family == kIPv4) header.source = address_at<ip::address_v4>(bytes, kStart);
  if (family == kIPv6) header.source = address_at<ip::address_v6>(bytes, kStart);
  return header;
}

}  // namespace

ProxyHeader ProxyHeader::read(std::string_view bytes) {
  if (!bytes.empty() && begins_as(bytes, kFirstVersion)) {
    if (bytes.size() < kFirstVersion.size()) return more(bytes.size() + 1);
    return refused("it is of version 1, and version 2 is wanted (haproxy: send-proxy-v2)");
  }
  if (!begins_as(bytes, kSignature)) return {Verdict::kNone, 0};
  if (bytes.size() < kSignature.size()) return more(bytes.size() + 1);
  if (bytes.size() < kStart) return more(kStart);
  const std::size_t size = kStart + length_at(bytes, kStart - 2);
  if (size > kMostBytes) return refused("it is longer than " + std::to_string(kMostBytes) + " bytes");
  if (bytes.size() < size) return more(size);
  return read_whole(bytes.substr(0, size));
}

}  // namespace woodlouse::server
