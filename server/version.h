// What the server calls itself on the wire and in recordings.
#pragma once

namespace woodlouse::server {

inline constexpr const char* kVersion = WOODLOUSE_VERSION;
inline constexpr const char* kServerName = "woodlouse-server " WOODLOUSE_VERSION;

}  // namespace woodlouse::server
