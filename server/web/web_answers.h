// What is answered to who asks by HTTP: the page, what this is, which rooms there are, whether it serves.
// Of the path that was asked for nothing comes back.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "server/room/directory.h"
#include "server/web/page_files.h"

namespace woodlouse::server {

struct WebAnswer {
  std::uint32_t status = 200;
  std::string_view type = "text/plain; charset=utf-8";
  std::string body{};
  std::string_view fixed{};  ///< in its place; as long as the server lives
  std::string_view cache = "no-store";
  std::string etag{};      ///< in quotes; empty: none
  bool is_packed = false;  ///< gzip
  bool varies = false;     ///< with what the client unpacks
  [[nodiscard]] std::string_view content() const {
    return fixed.data() != nullptr ? fixed : std::string_view(body);
  }
};

/// What is asked, as it was said.
struct WebQuestion {
  std::string_view target;  ///< with its query
  std::string_view host;    ///< by which name or address, without a port
  std::string_view accept_encoding{};
  std::string_view if_none_match{};
};

/// What a page says of its server.
struct WebFacts {
  std::string_view server_name;  ///< with its version
  std::uint16_t lines_port = 0;  ///< where the server speaks first
  bool is_stopping = false;
  const PageFiles* pages = nullptr;  ///< null: there is no page, and / is /about
};

[[nodiscard]] WebAnswer answer_to(const WebQuestion& question, const Directory& directory,
                                  const WebFacts& facts, Time now);

/// Of /readyz. why_not: Directory::why_not_ready().
[[nodiscard]] WebAnswer readiness(bool is_stopping, std::string_view why_not);

/// One line, and a line's end.
[[nodiscard]] WebAnswer refusal(std::uint32_t status, std::string_view why);

/// For an HTML text or attribute.
[[nodiscard]] std::string html_escaped(std::string_view text);

}  // namespace woodlouse::server
