#include "server/admin_options.h"

#include <CLI/CLI.hpp>

#include <utility>

namespace woodlouse::server {

void add_admin_options(CLI::App& app, TypedAdmin& typed) {
  app.add_option(
         "--admin", typed.where,
         "The operator's door: PATH of a Unix socket, or HOST:PORT on this machine; printed as `admin "
         "PATH`. `default`: $XDG_RUNTIME_DIR/woodlouse.sock. Left out: there is none")
      ->envname("WOODLOUSE_ADMIN");
  app.add_option("--admin-token-file", typed.token_file,
                 "File of the token that --admin HOST:PORT asks for: one line of 8 to 256 characters")
      ->envname("WOODLOUSE_ADMIN_TOKEN_FILE");
}

core::Expected<std::optional<AdminSettings>> checked_admin(const TypedAdmin& typed) {
  if (!typed.where) {
    if (!typed.token_file) return std::nullopt;
    return core::fail("--admin-token-file", "there is no door that asks for it",
                      "say where:  --admin 127.0.0.1:7779");
  }
  auto where = *typed.where == "default" ? core::Expected<AdminAddress>(default_admin_socket())
                                         : parse_admin_address(*typed.where, "--admin");
  if (!where) return tl::unexpected(where.error());
  const bool is_port = std::holds_alternative<ListenAddress>(*where);
  if (is_port && !typed.token_file)
    return core::fail("--admin " + *typed.where, "whoever is on this machine could command the server",
                      "--admin-token-file FILE, or a Unix socket, which its mode guards:  --admin PATH");
  if (!is_port && typed.token_file)
    return core::fail("--admin-token-file", "a Unix socket is guarded by its mode and asks for no token",
                      "leave it out");
  return AdminSettings{std::move(*where), typed.token_file};
}

}  // namespace woodlouse::server
