// Under which names a server may be asked by a browser, and by which pages: what keeps a stranger's page from
// speaking to a server of its reader's own network. Pure.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/net/listen_address.h"
#include "server/net/tls_context.h"
#include "shared/core/error.h"

namespace woodlouse::server {

/// What stands in a request's Host, and in an origin behind its scheme.
struct Authority {
  std::string host;                   ///< lower case; IPv6 without brackets
  std::optional<std::uint16_t> port;  ///< none: the scheme's own
  friend bool operator==(const Authority&, const Authority&) = default;
};

/// NAME, NAME:PORT, [IPV6], [IPV6]:PORT; nothing where it is none of them.
[[nodiscard]] std::optional<Authority> parse_authority(std::string_view text);

/// A page's: who served it.
struct Origin {
  bool is_secure = false;  ///< https
  std::string host;        ///< as an authority's
  std::uint16_t port = 80;
  friend bool operator==(const Origin&, const Origin&) = default;
};

/// http://NAME, https://NAME:PORT and the like, with nothing behind; nothing where it is none.
[[nodiscard]] std::optional<Origin> parse_origin(std::string_view text);

struct WebNames {
  std::vector<std::string> hosts;  ///< besides addresses and localhost; lower case
  std::vector<Origin> origins;     ///< besides the request's own
};

/// What is asked of the port on which the client speaks first.
struct WebSettings {
  ListenAddress listen;
  WebNames names;
  std::optional<TlsFiles> tls;                  ///< none: TLS is not spoken
  std::optional<std::filesystem::path> root{};  ///< a folder with the page's files; none: those built in
};

// As typed, checked. Errors: where = the option.
[[nodiscard]] core::Expected<std::string> checked_web_host(std::string_view text);
[[nodiscard]] core::Expected<Origin> checked_web_origin(std::string_view text);

/// Why a request with this Host is refused; empty: it is not. An address or localhost can't be another's
/// name for this server (DNS rebinding); other names only who runs it knows.
[[nodiscard]] std::string why_not_host(std::string_view host, const WebNames& names);

/// Why a page of this origin may open no session; empty: it may. host: of the request, which has passed.
[[nodiscard]] std::string why_not_origin(std::string_view origin, bool is_secure, std::string_view host,
                                         const WebNames& names);

}  // namespace woodlouse::server
