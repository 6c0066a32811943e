// Where the admin door is: a Unix socket, which its folder and mode guard, or a port of the machine itself,
// which a token guards.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "server/net/listen_address.h"
#include "shared/core/error.h"

namespace woodlouse::server {

using AdminAddress = std::variant<std::filesystem::path, ListenAddress>;

struct AdminSettings {
  AdminAddress where;
  std::optional<std::filesystem::path> token_file;  ///< with a port, and only there
};

inline constexpr std::uint16_t kDefaultAdminPort = 7779;

/// A text with a slash, or without a colon, is a socket's path; another one HOST:PORT. option: for errors.
core::Expected<AdminAddress> parse_admin_address(std::string_view text, std::string_view option);

/// $XDG_RUNTIME_DIR/woodlouse.sock, or, where there is none, /tmp/woodlouse-UID/admin.sock.
[[nodiscard]] std::filesystem::path default_admin_socket();

[[nodiscard]] std::string to_text(const AdminAddress& address);

}  // namespace woodlouse::server
