// The ground as a bot remembers it: squares of some metres, eight courses, a few speeds, and what it takes to
// drive from one square to the next with full thrust. Where a hill stops the drive, it leads back, faster by
// what the thrust gave both ways: a swing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/bots/effort.h"
#include "shared/core/vec2.h"

namespace woodlouse::server::bots {

class GroundMoves {
 public:
  static constexpr std::size_t kCourses = 8;                               ///< counter-clockwise from east
  static constexpr std::array kSpeeds = {0.0, 2.0, 4.5, 7.5, 11.0, 16.0};  ///< in space [m/s]

  struct Move {
    float seconds = 0.0F;
    float speed = 0.0F;       ///< at its end [m/s]
    std::int32_t to = -1;     ///< the square; -1: it leads off the map
    bool turns_back = false;  ///< it ends where it began, the other way round
  };

  explicit GroundMoves(const Effort& effort);

  [[nodiscard]] std::size_t squares() const { return columns_ * rows_; }
  /// REQUIRES speed < kSpeeds.size().
  [[nodiscard]] const Move& move(std::size_t square, std::size_t course, std::size_t speed) const {
    return moves_[(square * kCourses + course) * kSpeeds.size() + speed];
  }
  [[nodiscard]] core::Vec2 middle(std::size_t square) const;  ///< [m]
  [[nodiscard]] core::Vec2 step(std::size_t course) const;    ///< to the next middle [m]
  /// [m/s^2], beside friction.
  [[nodiscard]] double thrust() const { return effort_->thrust(); }
  [[nodiscard]] const Effort& effort() const { return *effort_; }

  /// The squares around a place, each with its weight, which add up to 1.
  struct Share {
    std::size_t square = 0;
    double weight = 0.0;
  };
  [[nodiscard]] std::array<Share, 4> around(core::Vec2 place) const;
  [[nodiscard]] std::size_t square_at(core::Vec2 place) const;

 private:
  [[nodiscard]] std::int32_t neighbour(std::size_t square, std::size_t course) const;
  [[nodiscard]] Move drive(std::size_t square, std::size_t course, double speed) const;

  const Effort* effort_;
  std::size_t columns_ = 0, rows_ = 0;
  core::Vec2 corner_, size_;  ///< of the map's south-west; of a square [m]
  std::vector<Move> moves_;
};

}  // namespace woodlouse::server::bots
