#include "server/access/secret.h"

#include <openssl/crypto.h>
#include <openssl/sha.h>

#include <algorithm>
#include <string>

#include "shared/core/joined.h"
#include "shared/core/whole_file.h"

namespace woodlouse::server {

Secret::Digest Secret::digest_of(std::string_view token) {
  Digest digest{};
  static_assert(SHA256_DIGEST_LENGTH == sizeof(digest));
  ::SHA256(reinterpret_cast<const unsigned char*>(token.data()), token.size(), digest.data());
  return digest;
}

bool Secret::matches(const Digest& digest) const {
  return ::CRYPTO_memcmp(digest_.data(), digest.data(), digest.size()) == 0;
}

bool may_be_secret(std::string_view token) {
  return token.size() >= kLeastSecretBytes && token.size() <= kMostSecretBytes &&
         std::all_of(token.begin(), token.end(), [](char c) { return c > 0x20 && c < 0x7f; });
}

core::Expected<Secret> read_secret(std::string_view option, const std::filesystem::path& file) {
  const std::string where = core::joined({option, " ", file.string()});
  auto bytes = core::read_whole_file(file, kMostSecretBytes + 2);
  if (!bytes) return core::fail(where, bytes.error().what, bytes.error().hint);
  std::string_view token = *bytes;
  while (token.ends_with('\n') || token.ends_with('\r')) token.remove_suffix(1);
  if (!may_be_secret(token))
    return core::fail(where, "is not one line of 8 to 256 visible ASCII characters",
                      "make one:  head -c 24 /dev/urandom | base64 > FILE");
  return Secret(token);
}

}  // namespace woodlouse::server
