#include "server/access/claim.h"

#include <openssl/sha.h>

#include <cstring>

namespace woodlouse::server {

TokenDigest digest_of(const ResumeToken& token) {
  const std::string text = to_text(token);
  std::array<unsigned char, SHA256_DIGEST_LENGTH> bytes{};
  SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(), bytes.data());
  TokenDigest digest{};
  static_assert(sizeof digest == sizeof bytes);
  std::memcpy(digest.data(), bytes.data(), bytes.size());
  return digest;
}

}  // namespace woodlouse::server
