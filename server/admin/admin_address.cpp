#include "server/admin/admin_address.h"

#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <utility>

#include "shared/core/joined.h"

namespace woodlouse::server {

core::Expected<AdminAddress> parse_admin_address(std::string_view text, std::string_view option) {
  const std::string where = core::joined({option, " ", text});
  if (text.find('/') == std::string_view::npos && text.find(':') != std::string_view::npos) {
    auto address = parse_listen_address(text, option, kDefaultAdminPort);
    if (!address) return tl::unexpected(address.error());
    return AdminAddress(std::move(*address));
  }
  if (text.empty() || text.ends_with('/') || text.find('\0') != std::string_view::npos)
    return core::fail(where, "is no socket's path",
                      "for example  /run/woodlouse/admin.sock  or 127.0.0.1:7779");
  if (text.size() >= sizeof(sockaddr_un::sun_path))
    return core::fail(where, "is too long for a socket's path: at most 107 bytes",
                      "a folder nearer to the root, or a path from where the server is started");
  return AdminAddress(std::filesystem::path(text));
}

std::filesystem::path default_admin_socket() {
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  if (runtime != nullptr && *runtime == '/') return std::filesystem::path(runtime) / "woodlouse.sock";
  return "/tmp/woodlouse-" + std::to_string(::getuid()) + "/admin.sock";
}

std::string to_text(const AdminAddress& address) {
  if (const auto* path = std::get_if<std::filesystem::path>(&address)) return path->string();
  return to_text(std::get<ListenAddress>(address));
}

}  // namespace woodlouse::server
