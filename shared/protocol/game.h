// What the rules of play show of a room's game: the member `game` of keys and deltas.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "shared/core/vec2.h"
#include "shared/json/object_text.h"

namespace woodlouse::protocol {

inline constexpr std::size_t kMaxTableRows = 10;  ///< of a table on the wire

enum class GamePhase : std::uint8_t { kGather, kCountdown, kPlay, kPodium };
std::string_view to_text(GamePhase phase);
std::optional<GamePhase> game_phase_from_text(std::string_view text);

struct GameCrumb {
  std::uint32_t slot = 0;
  core::Vec2 position;      ///< [m], in multiples of 1/1024
  std::uint32_t value = 0;  ///< 0: eaten
  friend bool operator==(const GameCrumb&, const GameCrumb&) = default;
};

struct GameTableRow {
  std::uint32_t id = 0;
  std::int64_t score = 0;  ///< points; of a race the best run in moments, 0: none
  friend bool operator==(const GameTableRow&, const GameTableRow&) = default;
};

struct GameHill {
  std::uint32_t place = 0;   ///< which of the mode's places counts, from 0
  std::uint32_t holder = 0;  ///< 0: nobody
  bool is_contested = false;
  std::uint64_t moves_at = 0;  ///< tick
  friend bool operator==(const GameHill&, const GameHill&) = default;
};

/// Of a key: whole. Of a delta: with those members alone that are otherwise than in its key, and of the
/// crumbs those.
struct Game {
  std::optional<GamePhase> phase;
  std::optional<std::uint32_t> round;
  std::optional<std::uint64_t> until;  ///< the tick at which the phase ends; 0: when somebody comes
  std::vector<GameCrumb> crumbs;       ///< by ascending slot
  std::optional<GameHill> hill;
  std::optional<std::vector<GameTableRow>> table;  ///< the best, first first
  friend bool operator==(const Game&, const Game&) = default;

  [[nodiscard]] bool empty() const { return *this == Game{}; }
};

/// What of `now`, which is whole, is otherwise than in `key`, which is, too.
Game difference(const Game& key, const Game& now);
/// `key`, which is whole, with what a delta says.
void apply(Game& key, const Game& delta);

/// As the members of a JSON object.
void append_game(json::ObjectText& text, const Game& game);

/// As the member `table`.
void append_table(json::ObjectText& text, const std::vector<GameTableRow>& table);

}  // namespace woodlouse::protocol
