// What an operator may ask of a running server: a JSON object a line, as the wire's messages are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "shared/protocol/codec.h"

namespace woodlouse::server {

/// In the order of kVerbs (command.cpp), which says what each takes.
enum class Verb : std::uint8_t {
  kStatus,
  kRooms,
  kOpen,
  kClose,
  kKick,
  kBan,
  kUnban,
  kBans,
  kMute,
  kUnmute,
  kSay,
  kPause,
  kResume,
  kStep,
  kRecord,
  kReload,
  kDrain,
  kShutdown,
};

/// Which of the members count goes with the verb; the others are as they are here.
struct Command {
  Verb verb = Verb::kStatus;
  std::string who;   ///< a name or an address, or of kick and mute also the number of a louse
  std::string room;  ///< empty: every one, or where one is meant the only one
  std::string file;  ///< of a map
  std::string name;  ///< of the room that is opened; empty: its map's
  std::string text;  ///< what is said
  std::optional<std::uint64_t> seconds;  ///< how long, or until when
  std::uint64_t ticks = 1;
  bool on = false;
};

/// A line of the door: a command, and who may say so (needed where the door is a port).
struct AdminLine {
  Command command;
  std::string token;
};

inline constexpr std::size_t kMostCommandBytes = 8192;  ///< of a line
inline constexpr std::uint64_t kMostSeconds = 10'000ull * 86'400;
inline constexpr std::uint64_t kMostDrainSeconds = 86'400;
inline constexpr std::uint64_t kMostSteps = 36'000;
inline constexpr std::size_t kMostWhoBytes = 64;  ///< an address of IPv6 with bits; a name has fewer
inline constexpr std::size_t kMostPathBytes = 4096;

[[nodiscard]] std::string_view to_text(Verb verb);

/// Errors: in the wire's codes.
tl::expected<AdminLine, protocol::DecodeError> decode_command(std::string_view line);
/// A whole line; what is empty or stands for nothing is left out.
std::string encode(const AdminLine& line);

}  // namespace woodlouse::server
