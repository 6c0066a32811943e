// What the physics target plays: a small map, in the words of a map file, and a script of what happens on it,
// both read from the input's bytes. Any bytes make a game, and every map in them is one that a server takes.
//
// The bytes' order; physics_seeds.py writes the same:
// - terrain (%5: GameGround), method (%3: standard, cheap, precise), bits (1 unilateral, 2 wrap, 4 central
//   gravity, 8 the default core, 16 open edges, 32 a tolerance), ticks a second less 1 (a pair, %1000)
// - gravity, drag, friction, thrust_max (numbers), edge_restitution (a byte of 255), central_gravity,
//   core_radius (numbers); with a tolerance that (number, of 1)
// - of a function: which (%5), grid less 2 (%4), scale (number)
// - of heights: columns less 4 (%9), rows less 4 (%9), dx, dy (numbers; 0: dx), steepness (halvings, %32), a
//   signed byte a height; a plane has two, its slopes
// - lice less 1 (%4), then of each: x, y (of the domain, pairs), the velocity's direction (of a turn), speed
//   (number), the heading (of a turn)
// - ticks less 1 (%32), then for each tick up to four deeds, or up to one that is none: %8: 1 vector, 2
//   number, 3 no thrust, 4 a louse comes, 5 it goes; + 8 * which louse. A vector is two signed bytes of 127,
//   a number one, then its ticks (255: held). A louse that comes is as above
//
// A pair is two bytes, low first. A number is a byte e (%40) and a byte m: m 2^(e - 27), within the field's
// range.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/joined.h"
#include "shared/core/vec2.h"
#include "shared/json/text.h"
#include "shared/map/spawns.h"
#include "shared/state/parameters.h"
#include "shared/state/thrust.h"
#include "shared/terrain/function_surface.h"

namespace woodlouse::fuzz {

/// The input's bytes, one after the other; 0 after the last.
class Bytes {
 public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint32_t next() { return at_ < bytes_.size() ? bytes_[at_++] : 0u; }
  std::uint32_t below(std::uint32_t end) { return next() % end; }
  std::uint32_t pair() {
    const std::uint32_t low = next();
    return low + 256 * next();
  }
  double signed_byte() { return static_cast<std::int8_t>(next()); }
  /// 0 or more; no smaller than `low` and no larger than `high`.
  double number(double low, double high) {
    const int exponent = static_cast<int>(below(40)) - 27;
    return std::clamp(std::ldexp(static_cast<double>(next()), exponent), low, high);
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

/// A louse that comes.
struct Arrival {
  core::Vec2 place;  ///< 0 to 1, of the domain each way
  core::Vec2 velocity;
  core::Vec2 heading;
};

enum class DeedKind { kNone, kThrust, kComes, kGoes };

struct Deed {
  DeedKind kind = DeedKind::kNone;
  std::uint32_t which = 0;  ///< louse
  state::Thrust thrust;
  std::uint32_t ticks = 0;
  Arrival arrival;
};

struct Game {
  std::string map;    ///< its file's text
  double step = 0.0;  ///< [s]
  std::vector<Arrival> arrivals;
  std::vector<std::vector<Deed>> ticks;  ///< what happens before each
};

inline Arrival read_arrival(Bytes& bytes) {
  constexpr double kDegrees = 360.0 / 256.0, kLast = 65535.0, kMaxSpeed = 1000.0;
  Arrival arrival;
  arrival.place.x = bytes.pair() / kLast;
  arrival.place.y = bytes.pair() / kLast;
  const core::Vec2 direction = map::heading_from_degrees(bytes.next() * kDegrees);
  arrival.velocity = bytes.number(0.0, kMaxSpeed) * direction;
  arrival.heading = map::heading_from_degrees(bytes.next() * kDegrees);
  return arrival;
}

inline Deed read_deed(Bytes& bytes) {
  constexpr double kWhole = 127.0;
  const std::uint32_t word = bytes.next();
  Deed deed;
  deed.which = word / 8;
  switch (word % 8) {
    case 1: {
      const double x = bytes.signed_byte() / kWhole;
      deed.thrust = state::rounded_map_vector({x, bytes.signed_byte() / kWhole}).thrust;
      break;
    }
    case 2:
      deed.thrust = state::rounded_along_heading(bytes.signed_byte() / kWhole).thrust;
      break;
    case 3:
      deed.kind = DeedKind::kThrust;
      return deed;
    case 4:
      deed.kind = DeedKind::kComes;
      deed.arrival = read_arrival(bytes);
      return deed;
    case 5:
      deed.kind = DeedKind::kGoes;
      return deed;
    default:
      return deed;
  }
  deed.kind = DeedKind::kThrust;
  deed.ticks = bytes.next();
  if (deed.ticks == 255) deed.ticks = state::kHeld;
  return deed;
}

enum class GameGround { kFunction, kFunctionSpline, kSpline, kNaturalSpline, kPlane };

/// The heights of knots, their rim repeated where the edges wrap; neighbours differ by less than the 100 m a
/// metre that a map may have.
inline std::string read_heights(Bytes& bytes, GameGround ground, bool wraps) {
  constexpr double kSteepest = 50.0, kHighest = 1e6, kWhole = 128.0;
  const std::size_t columns = 4 + bytes.below(9);
  const std::size_t rows = 4 + bytes.below(9);
  const double dx = bytes.number(1e-3, 1e5);
  const double given = bytes.number(0.0, 1e5);
  const double dy = given == 0.0 ? dx : std::max(given, 1e-3);
  const double steepness = std::ldexp(kSteepest, -static_cast<int>(bytes.below(32)));
  const double highest =
      ground == GameGround::kPlane ? 0.5 * kHighest : kHighest;  // a plane's is of two sides
  const double height = std::min(steepness * std::min(dx, dy), highest) / kWhole;
  std::vector<double> heights(columns * rows);
  if (ground == GameGround::kPlane) {
    const double east = wraps ? 0.0 : bytes.signed_byte() / static_cast<double>(columns);
    const double north = wraps ? 0.0 : bytes.signed_byte() / static_cast<double>(rows);
    for (std::size_t k = 0; k < heights.size(); ++k) {
      heights[k] =
          height * (east * static_cast<double>(k % columns) + north * static_cast<double>(k / columns));
    }
  } else {
    for (double& z : heights) z = height * bytes.signed_byte();
  }
  if (wraps) {
    for (std::size_t j = 0; j < rows; ++j) heights[j * columns + columns - 1] = heights[j * columns];
    for (std::size_t i = 0; i < columns; ++i) heights[(rows - 1) * columns + i] = heights[i];
  }
  std::string text = core::joined(
      {R"({"spacing":[)", json::double_text(dx), ",", json::double_text(dy), R"(],"heights":[)"});
  for (std::size_t k = 0; k < heights.size(); ++k) {
    text.append(k % columns != 0 ? "," : (k == 0 ? "[" : "],[")).append(json::double_text(heights[k]));
  }
  return text.append("]]}");
}

inline std::string read_function(Bytes& bytes, bool wraps) {
  constexpr std::array<std::string_view, 5> kNames = {"waves", "parabolic_pot", "wavy_pot", "volcano",
                                                      "hills"};
  const std::size_t chosen = bytes.below(kNames.size());
  const std::string_view name = kNames[wraps ? 0 : chosen];  // the one that repeats
  const std::uint32_t grid = 2 + bytes.below(4);
  const double scale = bytes.number(0.1, 1e5);
  return core::joined({R"({"function":")", name, R"(","grid":)", std::to_string(grid), R"(,"scale":)",
                       json::double_text(scale), "}"});
}

/// The map's text; `step` becomes the seconds of a tick.
inline std::string read_map(Bytes& bytes, double& step) {
  auto ground = static_cast<GameGround>(bytes.below(5));
  constexpr std::array kMethods = {state::Method::kStandard, state::Method::kCheap, state::Method::kPrecise};
  const state::Method method = kMethods[bytes.below(kMethods.size())];
  const std::uint32_t bits = bytes.next();
  const bool wraps = (bits & 2u) != 0;
  const bool unilateral = (bits & 1u) != 0;
  const std::string_view edges = wraps ? "wrap" : (bits & 16u) != 0 ? "open" : "walls";
  const bool central = (bits & 4u) != 0 && !wraps && !unilateral;
  if (wraps && ground == GameGround::kNaturalSpline) ground = GameGround::kSpline;
  step = 1.0 / (1 + bytes.pair() % 1000);

  std::string physics;
  const auto add = [&](std::string_view name, double value) {
    physics.append(core::joined({",\"", name, "\":", json::double_text(value)}));
  };
  add("gravity", bytes.number(0.0, 1000.0));
  add("drag", bytes.number(0.0, 100.0));
  add("friction", bytes.number(0.0, 10.0));
  add("thrust_max", bytes.number(0.0, 1000.0));
  add("edge_restitution", bytes.next() / 255.0);
  const double pull = bytes.number(0.0, 1e6);
  const double core = bytes.number(1e-3, 1e6);
  if (central) add("central_gravity", pull);
  if (central && pull > 0.0 && (bits & 8u) == 0) add("core_radius", core);
  if ((bits & 32u) != 0) add("tolerance", bytes.number(0.0, 1.0));

  const bool is_function = ground == GameGround::kFunction || ground == GameGround::kFunctionSpline;
  const std::string terrain = is_function ? read_function(bytes, wraps) : read_heights(bytes, ground, wraps);
  const std::string_view surface = ground == GameGround::kFunction        ? "function"
                                   : ground == GameGround::kNaturalSpline ? "natural_spline"
                                                                          : "spline";
  return core::joined({R"({"name":"fuzz","terrain":)", terrain, R"(,"surface":")", surface, R"(","edges":")",
                       edges, R"(","physics":{"contact":")", unilateral ? "unilateral" : "bilateral",
                       R"(","method":")", state::to_text(method), "\"", physics, "}}"});
}

inline Game read_game(std::span<const std::uint8_t> input) {
  constexpr std::size_t kMaxDeeds = 4;
  Bytes bytes(input);
  Game game;
  game.map = read_map(bytes, game.step);
  game.arrivals.resize(1 + bytes.below(4));
  for (Arrival& arrival : game.arrivals) arrival = read_arrival(bytes);
  game.ticks.resize(1 + bytes.below(32));
  for (std::vector<Deed>& deeds : game.ticks) {
    while (deeds.size() < kMaxDeeds) {
      const Deed deed = read_deed(bytes);
      if (deed.kind == DeedKind::kNone) break;
      deeds.push_back(deed);
    }
  }
  return game;
}

}  // namespace woodlouse::fuzz
