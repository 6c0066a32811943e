// The lines that the admin door answers with: {"type":"done",...} or {"type":"refused",...}, both with a text
// for people, of one line or more.
#pragma once

#include <string>
#include <string_view>

#include "shared/json/object_text.h"

namespace woodlouse::server {

// Codes of what is refused, besides the wire's. A promise to scripts, as those are.
namespace admin_code {
inline constexpr std::string_view kBadToken = "bad_token";
inline constexpr std::string_view kNobody = "nobody";
inline constexpr std::string_view kNotNow = "not_now";
inline constexpr std::string_view kFailed = "failed";
}  // namespace admin_code

/// add(ObjectText&): the members besides `type` and `text`.
template <typename Add>
std::string done(std::string_view text, const Add& add) {
  std::string line;
  json::ObjectText object(line, "done");
  object.text("text", text);
  add(object);
  object.end_line();
  return line;
}

inline std::string done(std::string_view text) {
  return done(text, [](json::ObjectText&) {});
}

inline std::string refused(std::string_view code, std::string_view text) {
  std::string line;
  json::ObjectText object(line, "refused");
  object.text("code", code).text("text", text);
  object.end_line();
  return line;
}

}  // namespace woodlouse::server
