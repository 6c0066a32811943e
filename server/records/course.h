// What a run is driven on, and by what its times are comparable: the key of a board.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "shared/core/error.h"
#include "shared/map/map_definition.h"

namespace woodlouse::server {

/// A longer map is only named in a board's file.
inline constexpr std::size_t kMaxBoardMapBytes = 1u << 20;

/// Of the ground, its physics, the race's spawns, gates and laps, the tick rate and the behavior; names,
/// medals and the lengths of rounds stand outside. REQUIRES a map with a race.
std::uint64_t course_key(const map::Map& map, std::uint32_t tick_hz, int behavior);

/// A board's first line.
struct BoardHeader {
  int behavior = 0;  ///< of whom it was driven with: another one can't re-run it
  std::uint32_t tick_hz = 0;
  std::uint64_t key = 0;
  std::string map_name;
  std::string definition;  ///< the canonical map; empty where it is longer than kMaxBoardMapBytes
  std::string map_file;    ///< its file's name, without a folder; of a map that is only named

  [[nodiscard]] bool can_be_re_run() const;
};

/// Of a course as it is driven now. map_file: where the map is.
BoardHeader header_of(const map::Map& map, std::uint32_t tick_hz, const std::string& map_file);
/// Newline included.
std::string header_line(const BoardHeader& header);
/// `name` is the file's, for errors.
core::Expected<BoardHeader> read_header_line(std::string_view line, std::string_view name);

}  // namespace woodlouse::server
