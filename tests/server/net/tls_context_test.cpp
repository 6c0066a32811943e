#include "server/net/tls_context.h"

#include <boost/asio/ssl/context.hpp>
#include <catch2/catch.hpp>

#include <filesystem>
#include <string>

namespace woodlouse::server::tls_context_test {

namespace {

std::filesystem::path pem(const std::string& name) {
  return std::filesystem::path(WOODLOUSE_SOURCE_DIR) / "tests/tls" / name;
}

}  // namespace

TEST_CASE("a certificate and its key are ready to be used") {
  const auto context = load_tls({pem("first_certificate.pem"), pem("first_key.pem")});
  REQUIRE(context);
  CHECK(*context != nullptr);
}

TEST_CASE("files of which TLS can't be spoken are refused with the option that names them") {
  const auto [certificate, key, option] = GENERATE(table<std::string, std::string, std::string>({
      {"none.pem", "first_key.pem", "--tls-cert"},
      {"first_certificate.pem", "none.pem", "--tls-key"},
      {"README.md", "first_key.pem", "--tls-cert"},
      {"first_certificate.pem", "README.md", "--tls-key"},
      {"first_key.pem", "first_certificate.pem", "--tls-cert"},
      {"first_certificate.pem", "second_key.pem", "--tls-key"},
      {"first_certificate.pem", "locked_key.pem", "--tls-key"},
      {"", "first_key.pem", "--tls-cert"},
  }));
  INFO(certificate << ' ' << key);
  const auto context = load_tls({pem(certificate), pem(key)});
  REQUIRE_FALSE(context);
  CHECK(context.error().where.starts_with(option));
  CHECK_FALSE(context.error().what.empty());
  CHECK_FALSE(context.error().hint.empty());
}

}  // namespace woodlouse::server::tls_context_test
