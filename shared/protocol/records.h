// Records of a race on the wire: the boards and their rows, and the ghosts that prove them. A ghost's line is
// also a row of a board's file, and what is handed in.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/state/ghost.h"
#include "shared/state/role.h"

namespace woodlouse::protocol {

inline constexpr std::size_t kMostRecordsShown = 20;
inline constexpr std::uint32_t kMostRank = 100;           ///< rows of a board
inline constexpr std::size_t kMostSplits = 32 * 100 + 1;  ///< gates and laps

/// Kept apart: who drove live, by the role they said, and what was handed in as a file.
enum class Board : std::uint8_t { kPeople, kBots, kHandedIn };
inline constexpr std::array kBoards = {Board::kPeople, Board::kBots, Board::kHandedIn};
/// "people", "bots" or "handed_in".
std::string_view to_text(Board board);
std::optional<Board> board_from_text(std::string_view text);

/// A run, as it is said to have been. Times are in moments, 1/65536 of a tick.
struct RecordRun {
  Board board = Board::kPeople;
  std::string name;  ///< as its driver was called; proves nothing
  state::Role role = state::Role::kPlayer;
  std::uint64_t time = 0;
  std::vector<std::uint64_t> splits;  ///< at each gate behind the first, since that; the last is the time
  std::uint64_t when = 0;             ///< seconds since 1970 UTC
  friend bool operator==(const RecordRun&, const RecordRun&) = default;
};

struct RecordRow {
  std::uint32_t rank = 0;  ///< from 1
  RecordRun run;
  friend bool operator==(const RecordRow&, const RecordRow&) = default;
};

struct ListRecords {
  Board board = Board::kPeople;
  friend bool operator==(const ListRecords&, const ListRecords&) = default;
};
/// The best, first first.
struct Records {
  Board board = Board::kPeople;
  std::uint32_t count = 0;  ///< rows that the board has
  std::vector<RecordRow> rows;
  friend bool operator==(const Records&, const Records&) = default;
};

struct GetGhost {
  Board board = Board::kPeople;
  std::uint32_t rank = 1;  ///< 1..kMostRank
  friend bool operator==(const GetGhost&, const GetGhost&) = default;
};
/// What drives the run again (match/ghost.h).
struct GhostLine {
  RecordRun run;
  std::uint64_t start = 0;  ///< when it drove through the first gate, in moments since its spawn
  int behavior = 0;
  std::uint32_t tick_hz = 60;
  state::Ghost ghost;
  friend bool operator==(const GhostLine&, const GhostLine&) = default;
};

void append_line(std::string& out, const Records& records);
void append_line(std::string& out, const GhostLine& ghost);

}  // namespace woodlouse::protocol
