// How long it is to a gate from everywhere, at every course and speed: by moves over the ground
// (ground_moves.h), swings and run-ups among them, where a course turns by 45 degrees at most and to stop
// takes its time. With the gate behind it, so that one drives through the one as the other wants it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "server/bots/goal.h"
#include "server/bots/ground_moves.h"

namespace woodlouse::server::bots {

class GateField {
 public:
  static constexpr double kFar = 300.0;  ///< what can't be reached [s]

  /// after: what counts from the gate on; null: nothing. Both are used in the constructor alone, but `after`
  /// has to stay where it is.
  GateField(const GroundMoves& moves, const map::Gate& gate, const GateField* after);

  /// [s]; speed: over the map.
  [[nodiscard]] double seconds(core::Vec2 place, core::Vec2 velocity) const;
  /// Where to push there: a unit vector.
  [[nodiscard]] core::Vec2 course(core::Vec2 place, core::Vec2 velocity) const;

 private:
  [[nodiscard]] double value(std::size_t square, std::size_t course, double speed) const;
  [[nodiscard]] double through(std::size_t square, std::size_t course, double speed) const;
  [[nodiscard]] double cost(std::size_t square, std::size_t course, std::size_t speed) const;
  [[nodiscard]] double best(std::size_t square, std::size_t course, std::size_t speed) const;
  bool sweep(bool backwards);
  void note_gate();
  float& at(std::size_t square, std::size_t course, std::size_t speed) {
    return values_[(square * GroundMoves::kCourses + course) * GroundMoves::kSpeeds.size() + speed];
  }
  [[nodiscard]] double at(std::size_t square, std::size_t course, std::size_t speed) const {
    return values_[(square * GroundMoves::kCourses + course) * GroundMoves::kSpeeds.size() + speed];
  }

  const GroundMoves& moves_;
  Goal goal_;
  const GateField* after_;
  double lift_ = 0.0;                 ///< the speed that a gate in the air wants [m/s]
  std::vector<float> values_;         ///< [s]
  std::vector<std::uint8_t> passes_;  ///< whether a move leads through the gate: by square and course
};

}  // namespace woodlouse::server::bots
