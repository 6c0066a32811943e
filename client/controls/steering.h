// From pushes, turns and brakes to the thrust the wire carries. The heading lives here, in the client: the
// wire gets a map vector along it, with the ticks it is to act; a brake is the number -1.
//
// There are two ways to steer. By the heading: up pushes along it, left and right turn it. By the compass:
// each of the four pushes that way in the picture, two of them between, and the heading is where it pushes,
// or pushed last.
//
// A press without a known release is a pulse; repeats extend it, and so does a turn: in a terminal the key
// that turns ends the repeats of the one that pushes. Held and latched pushes go out as pulses too, renewed
// before they end, so that a client that dies or loses its line does not push for ever. Time is an argument;
// poll() says what to send, at most once a tick.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>

#include "shared/core/clock.h"
#include "shared/core/vec2.h"
#include "shared/state/louse.h"

namespace woodlouse::client {

enum class Turn : std::uint8_t { kLeft, kRight };

/// Where a push by the compass goes, in the picture.
enum class Side : std::uint8_t { kUp, kDown, kLeft, kRight };  // each beside the other way

/// What one input message asks for.
struct ThrustOrder {
  state::Thrust thrust;
  std::uint32_t ticks = 0;  ///< how long it acts, >= 1
  friend bool operator==(const ThrustOrder&, const ThrustOrder&) = default;
};

class Steering {
 public:
  static constexpr std::chrono::milliseconds kPulse{400};  ///< of a press, until set_pulse()
  static constexpr std::chrono::milliseconds kRenewBefore{
      200};                             ///< what is left of a held pulse when it is renewed
  static constexpr int kHeadings = 16;  ///< a turn is a 16th of the circle, 22.5 degrees

  explicit Steering(std::uint32_t tick_hz) : tick_hz_(tick_hz) {}

  /// Points along a unit vector, as after a spawn; what is pushed goes on.
  void point(core::Vec2 heading);
  /// Ends every push, the latched one too; the server has forgotten them as well.
  void reset();
  void turn(Turn direction, core::Time now);
  /// How long a press pushes from here on.
  void set_pulse(std::chrono::milliseconds pulse);

  void push(core::Time now);
  void brake(core::Time now);  ///< also ends cruise
  void hold_push() { push_held_ = true; }
  void hold_brake();  ///< also ends cruise
  void release_push();
  void release_brake();
  void toggle_cruise();
  // By the compass:
  /// The map's direction that goes up in the picture, a unit vector: pushes under way turn with it.
  void look_along(core::Vec2 up);
  void push_to(Side side, core::Time now);  ///< turns a cruise, too; ends a push the other way
  void hold_to(Side side, core::Time now);
  void release_to(Side side);
  void release_all();  ///< the terminal lost focus: releases will not be seen

  /// The order to send now, or nothing while the last one still says it.
  std::optional<ThrustOrder> poll(core::Time now);

  [[nodiscard]] core::Vec2 heading() const;
  [[nodiscard]] bool cruising() const { return cruise_; }
  [[nodiscard]] bool pushing(core::Time now) const;
  [[nodiscard]] bool braking(core::Time now) const { return brake_held_ || now < brake_until_; }
  /// How long the present push or brake still lasts by itself [s]; a held or latched one counts as a pulse.
  [[nodiscard]] double seconds_left(core::Time now) const;

 private:
  /// A push to one side.
  struct Press {
    bool held = false;
    core::Time until{};
    [[nodiscard]] bool acts(core::Time now) const { return held || now < until; }
  };

  /// Where the sides that act push together; zero: nowhere.
  [[nodiscard]] core::Vec2 sideways(core::Time now) const;
  void point_sideways(core::Time now);
  [[nodiscard]] state::Thrust wanted(core::Time now) const;
  [[nodiscard]] core::Time wanted_until(core::Time now) const;

  std::uint32_t tick_hz_;
  double base_angle_ = 0.0;  ///< [rad], of the heading before any turn
  int turns_ = 0;            ///< of 22.5 degrees, counter-clockwise
  bool cruise_ = false;
  bool push_held_ = false;
  bool brake_held_ = false;
  std::chrono::milliseconds pulse_ = kPulse;
  core::Vec2 up_{0.0, 1.0};
  std::array<Press, 4> sides_{};  ///< by Side
  core::Time push_until_{};
  core::Time brake_until_{};
  state::Thrust sent_;  ///< what the server was last told
  core::Time sent_until_{};
};

/// A unit vector as the wire can carry it: multiples of 1/128, rounded towards zero so that its length stays
/// at most 1 and the server changes nothing.
core::Vec2 wire_vector(core::Vec2 unit);

}  // namespace woodlouse::client
