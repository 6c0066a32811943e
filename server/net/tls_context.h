// A server's certificate and its key, ready to be used.
#pragma once

#include <filesystem>
#include <memory>

#include "shared/core/error.h"

namespace boost::asio::ssl {
class context;
}

namespace woodlouse::server {

/// Both in PEM; the certificate with those that vouch for it behind it, the key without a password.
struct TlsFiles {
  std::filesystem::path certificate;
  std::filesystem::path key;
};

/// TLS 1.2 and 1.3, without renegotiation. Reads the files. Errors: where = the option; one can't be read, is
/// no PEM, or they do not belong together. Connections that were made with it outlive it.
[[nodiscard]] core::Expected<std::shared_ptr<boost::asio::ssl::context>> load_tls(const TlsFiles& files);

}  // namespace woodlouse::server
