// What is answered to who asks by HTTP: what this is, which rooms there are, whether it serves. Pure, and of
// the path that was asked for nothing comes back.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "server/room/directory.h"

namespace woodlouse::server {

struct WebAnswer {
  std::uint32_t status = 200;
  std::string_view type = "text/plain; charset=utf-8";
  std::string body;
};

/// What a page says of its server.
struct WebFacts {
  std::string_view server_name;  ///< with its version
  std::uint16_t lines_port = 0;  ///< where the server speaks first
  bool is_stopping = false;
  bool are_ticks_overdue = false;  ///< a room's, by more than passes by itself
};

/// target: as it was asked, with its query. host: by which name or address, without a port.
[[nodiscard]] WebAnswer answer_to(std::string_view target, std::string_view host, const Directory& directory,
                                  const WebFacts& facts);

/// One line, and a line's end.
[[nodiscard]] WebAnswer refusal(std::uint32_t status, std::string_view why);

/// For an HTML text or attribute.
[[nodiscard]] std::string html_escaped(std::string_view text);

}  // namespace woodlouse::server
