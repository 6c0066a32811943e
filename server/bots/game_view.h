// What a client is shown of a game: the frames that bots look at. Filled from a match in one place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "shared/core/vec2.h"
#include "shared/match/match.h"
#include "shared/rules/round.h"
#include "shared/state/louse.h"

namespace woodlouse::server::bots {

struct Crumb {
  core::Vec2 at;            ///< [m]
  std::uint32_t value = 1;  ///< points
};

/// Where the hill is played for at present.
struct Place {
  core::Vec2 at;        ///< [m]
  double radius = 0.0;  ///< [m]; 0: there is none
};

struct GameView {
  std::uint64_t tick = 0;
  std::vector<state::Louse> lice;    ///< by ascending id
  std::vector<std::uint32_t> gates;  ///< of each of them the next one
  rules::Round round;
  std::vector<Crumb> crumbs;
  Place place;
  state::LouseId holder = 0;  ///< who is alone on the place; 0: nobody is

  /// Its place in `lice`; lice.size(): it is not there.
  [[nodiscard]] std::size_t find(state::LouseId louse) const;
};

/// What a frame of this tick shows.
void look(const match::Match& game, GameView& out);

/// The last frames, as a client gets them.
class Sight {
 public:
  static constexpr std::uint32_t kFramesPerSecond = 20;
  static constexpr double kOldest = 0.6;  ///< that is kept, at least [s]

  /// Before each tick: keeps a frame where one is due.
  void look(const match::Match& game);
  /// The newest that is at least so many ticks old; null: there is none yet.
  [[nodiscard]] const GameView* before(std::uint64_t tick, std::uint64_t ticks) const;

 private:
  std::deque<GameView> frames_;  ///< by tick
};

}  // namespace woodlouse::server::bots
