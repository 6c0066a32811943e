// The codes of `error`, `notice` and `bye`: one table for the code and for docs/protocol.md (a test compares
// the two). A code is a promise to clients: never renamed, never reused for something else.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace woodlouse::protocol {

namespace code {
// What is wrong with a line.
inline constexpr std::string_view kBadJson = "bad_json";
inline constexpr std::string_view kNotAnObject = "not_an_object";
inline constexpr std::string_view kDuplicateKey = "duplicate_key";
inline constexpr std::string_view kTooDeep = "too_deep";
inline constexpr std::string_view kUnknownType = "unknown_type";
inline constexpr std::string_view kMissingField = "missing_field";
inline constexpr std::string_view kBadField = "bad_field";
inline constexpr std::string_view kBadProtocol = "bad_protocol";
inline constexpr std::string_view kLineTooLong = "line_too_long";
// What is wrong with the moment.
inline constexpr std::string_view kNotJoined = "not_joined";
inline constexpr std::string_view kAlreadyJoined = "already_joined";
inline constexpr std::string_view kUnknownRoom = "unknown_room";
inline constexpr std::string_view kRoomFull = "room_full";
inline constexpr std::string_view kTooManyConnections = "too_many_connections";
inline constexpr std::string_view kRateLimited = "rate_limited";
inline constexpr std::string_view kFlood = "flood";
inline constexpr std::string_view kHandshakeTimeout = "handshake_timeout";
inline constexpr std::string_view kIdle = "idle";
inline constexpr std::string_view kSlow = "slow";
// Why the operator, or a password, stands in the way.
inline constexpr std::string_view kBanned = "banned";
inline constexpr std::string_view kKicked = "kicked";
inline constexpr std::string_view kMuted = "muted";
inline constexpr std::string_view kBadToken = "bad_token";
inline constexpr std::string_view kNoRight = "no_right";
inline constexpr std::string_view kNotModerated = "not_moderated";
// Why an input was dropped.
inline constexpr std::string_view kStaleSeq = "stale_seq";
inline constexpr std::string_view kQueueFull = "queue_full";
inline constexpr std::string_view kTooFar = "too_far";
inline constexpr std::string_view kNoLouse = "no_louse";
// What is not there.
inline constexpr std::string_view kNoRecords = "no_records";
inline constexpr std::string_view kNoVote = "no_vote";
inline constexpr std::string_view kOnlyShown = "only_shown";
// The end without a fault.
inline constexpr std::string_view kLeft = "left";
inline constexpr std::string_view kShutdown = "shutdown";
inline constexpr std::string_view kReplaced = "replaced";
inline constexpr std::string_view kMoved = "moved";
// Notices.
inline constexpr std::string_view kRateLowered = "rate_lowered";
inline constexpr std::string_view kKeysOnly = "keys_only";
inline constexpr std::string_view kRateRestored = "rate_restored";
inline constexpr std::string_view kDraining = "draining";
inline constexpr std::string_view kPaused = "paused";
inline constexpr std::string_view kResumed = "resumed";
inline constexpr std::string_view kOperator = "operator";
inline constexpr std::string_view kModerated = "moderated";
inline constexpr std::string_view kRecordingEnded = "recording_ended";
inline constexpr std::string_view kNotDurable = "not_durable";
inline constexpr std::string_view kDurable = "durable";
}  // namespace code

/// Whether the connection ends with it. kRepeated: when three lines running were not JSON.
enum class Ends : std::uint8_t { kNo, kRepeated, kYes };

struct CodeEntry {
  std::string_view code;
  std::string_view messages;  ///< the messages that carry it: "error", "error, bye", "bye", "notice"
  Ends ends;
  std::string_view meaning;
};

/// Every code there is, in the order of docs/protocol.md.
std::span<const CodeEntry> codes();

}  // namespace woodlouse::protocol
