// What a server allows, as hello.limits declares it: one table for the wire, for the server's options and for
// docs/protocol.md (a test compares the two).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace woodlouse::protocol {

/// More rows than a room has lice.
inline constexpr std::uint32_t kEveryRow = 1'000'000;

/// The defaults are a server's. Whoever decodes a hello finds 0 for what an older server does not declare.
struct Limits {
  std::uint32_t line = 4096;  ///< kMaxLineBytes
  std::uint32_t depth = 8;    ///< kMaxDepth
  std::uint32_t messages_per_s = 60;
  std::uint32_t burst = 120;
  std::uint32_t outbox_bytes = 4u << 20;  ///< queued events and answers; frames are replaced, never queued
  std::uint32_t handshake_s = 10;
  std::uint32_t idle_s = 60;
  std::uint32_t per_address = 256;
  std::uint32_t per_room = 512 + 512 + 8192;  ///< players, bots and spectators together
  std::uint32_t max_connections = 10'000;
  std::uint32_t max_players = 512;
  std::uint32_t max_bots = 512;
  std::uint32_t max_spectators = 8192;
  std::uint32_t layouts_per_address = 4;
  std::uint32_t inputs_per_tick = 8;
  std::uint32_t frame_rows = kEveryRow;
  std::uint32_t chat_per_s = 2;
  std::uint32_t chat_per_s_address = 16;
  std::uint32_t chat_per_s_room = 32;
  std::uint32_t respawn_per_s = 2;
  std::uint32_t respawn_per_s_address = 16;
  std::uint32_t respawn_per_s_room = 64;
  std::uint32_t join_per_s_address = 32;
  std::uint32_t join_per_s_room = 128;
  std::uint32_t line_bytes_per_s = 256u << 10;
  std::uint32_t line_bytes_per_s_address = 2u << 20;
  std::uint32_t answer_bytes_per_s = 512u << 10;
  std::uint32_t answer_bytes_per_s_address = 4u << 20;
  std::uint32_t ping_s = 5;
  std::uint32_t vacant_s = 15;
  std::uint32_t resume_s = 30;
  friend bool operator==(const Limits&, const Limits&) = default;
};

/// What `..._per_s` counts may be saved up for: so many seconds' worth may come at once.
inline constexpr std::uint32_t kSavedSeconds = 8;

struct LimitField {
  std::string_view name;  ///< on the wire; an option is named so with '-' for '_'
  std::uint32_t Limits::*member;
  std::uint32_t least, most;  ///< of an option
  std::string_view unit;      ///< empty: a count
  std::string_view meaning;
  /// Those that protocol 1 began with: a hello must have them.
  bool is_old = false;
  bool is_option = true;  ///< false: what the format or other limits give
};

/// In the order of the wire and of docs/protocol.md.
std::span<const LimitField> limit_fields();

}  // namespace woodlouse::protocol
