#include "server/proxies/proxy_header.h"

#include <catch2/catch.hpp>

#include <string>
#include <string_view>

namespace woodlouse::server::proxy_header_test {

namespace {

using Verdict = ProxyHeader::Verdict;

constexpr std::string_view kSignature("\r\n\r\n\0\r\nQUIT\n", 12);
constexpr std::string_view kFourAddresses("\xc0\x00\x02\x01\xc0\x00\x02\x02\x30\x39\x1e\x61",
                                          12);  // 192.0.2.1 to .2

std::string header(unsigned command, unsigned family, std::string_view rest) {
  std::string text(kSignature);
  text += static_cast<char>(command);
  text += static_cast<char>(family);
  text += static_cast<char>(rest.size() >> 8);
  text += static_cast<char>(rest.size() & 0xff);
  return text.append(rest);
}

std::string tlv(unsigned type, std::string_view value) {
  std::string text(1, static_cast<char>(type));
  text += static_cast<char>(value.size() >> 8);
  text += static_cast<char>(value.size() & 0xff);
  return text.append(value);
}

std::string source_of(const std::string& bytes) {
  const ProxyHeader read = ProxyHeader::read(bytes);
  INFO(read.why);
  CHECK(read.verdict == Verdict::kWhole);
  CHECK(read.bytes <= bytes.size());
  return read.source ? read.source->to_string() : "";
}

std::string refusal_of(const std::string& bytes) {
  const ProxyHeader read = ProxyHeader::read(bytes);
  CHECK(read.verdict == Verdict::kRefused);
  CHECK_FALSE(read.source.has_value());
  return read.why;
}

}  // namespace

TEST_CASE("a PROXY header tells whose connection it is, and where it ends") {
  const std::string four = header(0x21, 0x11, kFourAddresses);
  CHECK(source_of(four) == "192.0.2.1");
  CHECK(ProxyHeader::read(four + "{\"type\":\"join\"}").bytes == four.size());
  const std::string six =
      std::string("\x20\x01\x0d\xb8", 4) + std::string(11, '\0') + '\x07' + std::string(20, '\0');
  CHECK(source_of(header(0x21, 0x21, six)) == "2001:db8::7");
  const std::string tlvs = tlv(0x04, "") + tlv(0x03, "crc!") + tlv(0x20, std::string(700, 'x'));
  CHECK(source_of(header(0x21, 0x11, std::string(kFourAddresses) + tlvs)) == "192.0.2.1");
}

TEST_CASE("a PROXY header of the proxy's own, or of who has no address, names nobody") {
  CHECK(source_of(header(0x20, 0x00, "")).empty());
  CHECK(source_of(header(0x20, 0x11, kFourAddresses)).empty());
  CHECK(source_of(header(0x20, 0xff, "whatever it is")).empty());
  CHECK(source_of(header(0x21, 0x00, "")).empty());
  CHECK(source_of(header(0x21, 0x00, "whatever")).empty());
  CHECK(source_of(header(0x21, 0x31, std::string(216, 'u'))).empty());
}

TEST_CASE("a PROXY header that is cut off anywhere wants more, and never less than it has") {
  const std::string whole = header(0x21, 0x11, std::string(kFourAddresses) + tlv(0x04, "padding"));
  for (std::size_t size = 1; size < whole.size(); ++size) {
    INFO(size);
    const ProxyHeader read = ProxyHeader::read(std::string_view(whole).substr(0, size));
    CHECK(read.verdict == Verdict::kMore);
    CHECK(read.bytes > size);
    CHECK(read.bytes <= whole.size());
  }
  CHECK(ProxyHeader::read(whole).verdict == Verdict::kWhole);
}

TEST_CASE("what is no PROXY header is told by the first byte that shows it") {
  const std::string whole = header(0x21, 0x11, kFourAddresses);
  for (std::size_t at = 0; at < kSignature.size(); ++at) {
    std::string other = whole.substr(0, at + 1);
    other[at] = '{';
    INFO(at);
    CHECK(ProxyHeader::read(other).verdict == Verdict::kNone);
  }
  for (const char* said : {"{\"type\":\"join\"}", "GET / HTTP/1.1", "POST / HTTP/1.1", "PUT", "\r\n{",
                           "PROXIES", "\x16\x03\x01"})
    CHECK(ProxyHeader::read(said).verdict == Verdict::kNone);
  CHECK(ProxyHeader::read("").verdict == Verdict::kMore);
}

TEST_CASE("a PROXY header of version 1 is refused in words") {
  for (std::size_t size = 1; size < 6; ++size)
    CHECK(ProxyHeader::read(std::string_view("PROXY ").substr(0, size)).verdict == Verdict::kMore);
  CHECK(refusal_of("PROXY TCP4 192.0.2.1 192.0.2.2 12345 7777\r\n").find("version 1") != std::string::npos);
}

TEST_CASE("a hostile PROXY header is refused, and says why") {
  CHECK(refusal_of(header(0x11, 0x11, kFourAddresses)) == "its version is not 2");
  CHECK(refusal_of(header(0x2f, 0x11, kFourAddresses)) == "its command is neither LOCAL nor PROXY");
  for (const unsigned family : {0x01u, 0x12u, 0x22u, 0x32u, 0x41u, 0xffu})
    CHECK(refusal_of(header(0x21, family, std::string(216, 'x'))).find("family") != std::string::npos);
  for (std::size_t size = 0; size < kFourAddresses.size(); ++size)
    CHECK(refusal_of(header(0x21, 0x11, kFourAddresses.substr(0, size))).find("too short") !=
          std::string::npos);
  CHECK(refusal_of(header(0x21, 0x21, std::string(35, 'x'))).find("too short") != std::string::npos);
  CHECK(refusal_of(header(0x21, 0x31, std::string(215, 'x'))).find("too short") != std::string::npos);
  const std::string start(kFourAddresses);
  for (const std::string& end : {std::string("\x04"), std::string("\x04\x00", 2),
                                 std::string("\x04\x00\x02x", 4), std::string("\x04\xff\xff", 3)})
    CHECK(refusal_of(header(0x21, 0x11, start + end)).find("TLVs") != std::string::npos);
}

TEST_CASE("a PROXY header of a huge length is refused before the rest comes") {
  std::string start = header(0x21, 0x11, "").substr(0, 14);
  CHECK(refusal_of(start + "\xff\xff").find("longer than") != std::string::npos);
  const std::size_t most = ProxyHeader::kMostBytes - 16;
  CHECK(refusal_of(start + static_cast<char>((most + 1) >> 8) + static_cast<char>((most + 1) & 0xff))
            .find("longer") != std::string::npos);
  const ProxyHeader fits =
      ProxyHeader::read(start + static_cast<char>(most >> 8) + static_cast<char>(most & 0xff));
  CHECK(fits.verdict == Verdict::kMore);
  CHECK(fits.bytes == ProxyHeader::kMostBytes);
}

}  // namespace woodlouse::server::proxy_header_test
