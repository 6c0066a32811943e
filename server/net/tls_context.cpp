#include "server/net/tls_context.h"

#include <openssl/ssl.h>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/system/error_code.hpp>

#include <cstddef>
#include <string>

#include "shared/core/whole_file.h"

// All of Asio's TLS that is not a template, as cmake/asio.cpp has the rest.
#include <boost/asio/ssl/impl/src.hpp>

namespace woodlouse::server {
namespace {

namespace ssl = boost::asio::ssl;
using boost::system::error_code;

constexpr std::size_t kMostBytes = 1u << 20;

core::Error fault(const std::string& option, const std::filesystem::path& file, const std::string& what) {
  return {option + ' ' + file.string(), what,
          "both are PEM files, as certbot writes them: fullchain.pem, privkey.pem"};
}

}  // namespace

core::Expected<std::shared_ptr<ssl::context>> load_tls(const TlsFiles& files) {
  const auto certificate = core::read_whole_file(files.certificate, kMostBytes);
  if (!certificate) return tl::unexpected(fault("--tls-cert", files.certificate, certificate.error().what));
  const auto key = core::read_whole_file(files.key, kMostBytes);
  if (!key) return tl::unexpected(fault("--tls-key", files.key, key.error().what));
  auto context = std::make_shared<ssl::context>(ssl::context::tls_server);
  SSL_CTX* const native = context->native_handle();
  ::SSL_CTX_set_min_proto_version(native, TLS1_2_VERSION);
  ::SSL_CTX_set_options(native, SSL_OP_NO_RENEGOTIATION | SSL_OP_CIPHER_SERVER_PREFERENCE);
  ::SSL_CTX_set_mode(native, SSL_MODE_RELEASE_BUFFERS);
  error_code error;
  // Else OpenSSL asks at the terminal.
  context->set_password_callback([](std::size_t, ssl::context::password_purpose) { return std::string(); },
                                 error);
  if (!error) context->use_certificate_chain(boost::asio::buffer(*certificate), error);
  if (error)
    return tl::unexpected(fault("--tls-cert", files.certificate, "is no certificate: " + error.message()));
  context->use_private_key(boost::asio::buffer(*key), ssl::context::pem, error);
  if (error)
    return tl::unexpected(fault("--tls-key", files.key,
                                "is no key of that certificate without a password: " + error.message()));
  if (::SSL_CTX_check_private_key(native) != 1)
    return tl::unexpected(fault("--tls-key", files.key, "is not the key of that certificate"));
  return context;
}

}  // namespace woodlouse::server
