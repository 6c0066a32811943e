// A recording: one JSON object a line, written while the game runs, read by less, jq and the replayer.
//
//     {"format":"woodlouse-replay","version":3,"behavior":..,"build":..,"seed":"..","tick_hz":..,"mode":"race","map":{..}}
//     {"keyframe":n,"hash":..,"generator":..,"players":[..],"lice":[..],..}   all of the match at tick n
//     {"step":n,"roster":[..],"inputs":[..],"hash":"16 hex digits"}   step n -> n+1; the hash is tick n+1's
//     {"step":n,"steps":k,"hash":..}             k steps that applied nothing and changed nothing
//     {"chat":n,"player":..,"name":..,"text":..}                      for who reads; a re-run passes it over
//     {"pause":n,"from":..,"until":..}                               likewise: no tick passed meanwhile
//     {"index":n,"keyframes":[..],"players":[..],"marks":[..]}        where things stand
//     {"end":n,"reason":"..","index":offset}                          the last tick
//
// A keyframe stands first and then every kKeyframeSeconds; lines tell of every step, so a file that was cut
// off (SIGKILL) is good up to its last whole line. Field by field in docs/determinism.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "shared/match/match.h"
#include "shared/protocol/messages.h"

namespace woodlouse::replay {

inline constexpr std::string_view kFormat = "woodlouse-replay";
inline constexpr int kFormatVersion = 3;
inline constexpr std::size_t kMaxInlineMapBytes = 1u << 20;  ///< a longer map is named by hash and file
inline constexpr std::size_t kMaxReplayLineBytes = 32u << 20;
inline constexpr std::uint32_t kKeyframeSeconds = 5;
/// At once, and as many players. Twice what a server takes; each join, leave and respawn costs a walk through
/// them, and a name is kept of each.
inline constexpr std::size_t kMaxLice = 4096;
/// At the highest tick rate there is.
inline constexpr std::uint64_t kMaxStepsBetweenKeyframes = std::uint64_t{kKeyframeSeconds} * 1000;

/// The recording that a fork went on from.
struct Parent {
  std::string file;        ///< for people
  std::uint64_t tick = 0;  ///< where it went on
  std::uint64_t hash = 0;  ///< of that tick
  friend bool operator==(const Parent&, const Parent&) = default;
};

/// The first line: what was played, by which rules.
struct Header {
  int behavior = match::kBehavior;
  std::string build;  ///< name and version of the server, for people
  std::uint64_t seed = 0;
  std::uint32_t tick_hz = 60;
  state::Mode mode = state::Mode::kRoam;
  std::string map_name;
  std::uint64_t map_hash = 0;
  std::string map_definition;  ///< the canonical map; empty where it is longer than kMaxInlineMapBytes
  std::string map_file;        ///< where the server found it; only used when map_definition is empty
  std::optional<Parent> parent;
};

/// Of the match that was recorded.
inline match::MatchSettings settings_of(const Header& header) {
  return {header.tick_hz, header.seed, header.mode};
}

/// Whether a header has the map in it.
bool holds_map(const map::Map& map);
/// The header of a match. `map_file` as the server was given it.
Header make_header(const match::Match& match, std::string_view build, std::string_view map_file);

/// One step, or as many as `steps` says, which applied nothing and left the hash as it was. The margins stand
/// in the order of step.inputs.
struct StepLine {
  match::StepRecord step;
  std::vector<std::optional<std::int64_t>>
      margins_ms{};  ///< how long before its step it came; negative: late
  std::uint64_t steps = 1;
};
struct Keyframe {
  match::MatchState state;
};
struct ChatLine {
  std::uint64_t tick = 0;
  match::PlayerId player = 0;
  std::string name, text;
};
/// Nobody was there, and no tick passed; for people. Seconds since 1970, UTC, as the server's clock had them.
struct PauseLine {
  std::uint64_t tick = 0;
  std::uint64_t from = 0, until = 0;
};
/// Its contents are read from the end of the file (index.h); whoever reads on from above has seen them.
struct IndexLine {
  std::uint64_t tick = 0;
};
struct End {
  std::uint64_t tick = 0;
  std::string reason;
  std::uint64_t index_offset = 0;  ///< of the index line
};
using Line = std::variant<StepLine, Keyframe, ChatLine, PauseLine, IndexLine, End>;

}  // namespace woodlouse::replay
