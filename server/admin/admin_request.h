// HTTP at the admin door: one request a connection, GET and HEAD, for programs that look after the server.
// Pure.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "server/web/web_answers.h"
#include "shared/core/error.h"

namespace woodlouse::server {

inline constexpr std::size_t kMostAdminHeadBytes = 8192;

struct AdminRequest {
  std::string path;      ///< without its query
  std::string token;     ///< of `Authorization: Bearer`; empty: none
  bool is_head = false;  ///< asks for the head of the answer alone
};

/// Of a whole head, with its empty line. Errors: what it is answered.
tl::expected<AdminRequest, WebAnswer> read_request(std::string_view head);

/// The bytes of the answer, after which the connection ends.
std::string response_text(const WebAnswer& answer, bool is_head);

}  // namespace woodlouse::server
