// What a bot thinks may happen: from what it last saw to now by what it pushed since, and from there on a few
// ways to go on, tried in a small world of its own, each for some seconds. The best one's first push is what
// it does.
//
// Not thread safe; who plans needs it for one call.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "server/bots/effort.h"
#include "server/bots/goal.h"
#include "server/bots/skill.h"
#include "shared/map/map_definition.h"
#include "shared/physics/world.h"
#include "shared/state/louse.h"

namespace woodlouse::server::bots {

/// What was pushed from a moment on.
struct Push {
  double since = 0.0;  ///< [s], of the game
  state::Thrust thrust;
};

class Foresight {
 public:
  static constexpr double kStep = 0.05;  ///< of its world [s]

  /// map: outlives it.
  Foresight(const map::Map& map, const Ability& ability);

  struct Question {
    const state::Louse* louse = nullptr;  ///< as it was seen
    double seen = 0.0;                    ///< when [s]
    double now = 0.0;                     ///< from when on the answer acts [s]
    std::span<const Push> pushes;         ///< by time; those before `seen` but for the last are not looked at
    std::span<const Goal> goals;          ///< one after the other, at least one
  };
  /// The push that leads best: a map vector of length at most the ability's power.
  core::Vec2 best_push(const Question& question);
  /// The push of who swings: with the motion, downhill where there is none.
  core::Vec2 swing(const Question& question);
  /// Where a louse will be at `question.now` [m].
  const state::Louse& now(const Question& question);

  [[nodiscard]] const Effort& effort() const { return effort_; }

 private:
  enum class Then {
    kStraight,  ///< towards the goal
    kFollow,    ///< as its field says
    kSwing,     ///< the way it moves
  };
  /// A way to go on: first that push, then so.
  struct Try {
    core::Vec2 first;
    int first_steps = 0;
    Then then = Then::kStraight;
    std::size_t passed = 0;  ///< goals
    double cost = 0.0;       ///< gathered on the way
  };

  void catch_up(const Question& question, std::size_t& passed);
  void make_tries(const Goal& goal);
  [[nodiscard]] core::Vec2 towards(const state::Louse& louse, const Goal& goal) const;
  [[nodiscard]] core::Vec2 along(const state::Louse& louse, core::Vec2 ahead) const;
  [[nodiscard]] core::Vec2 push(Then then, const state::Louse& louse, const Goal& goal) const;
  [[nodiscard]] core::Vec2 with_motion(const state::Louse& louse, const Goal& goal) const;
  [[nodiscard]] bool passes(const state::Louse& before, const state::Louse& after, const Goal& goal) const;
  [[nodiscard]] double cost(const Try& one, const state::Louse& end, std::span<const Goal> goals) const;
  void run(std::span<const Goal> goals, std::size_t passed, int steps);

  Ability ability_;
  Effort effort_;
  physics::World world_;
  state::Louse now_;
  std::vector<Try> tries_;
  std::vector<state::Louse> lice_;  ///< one a try; before its step
};

}  // namespace woodlouse::server::bots
