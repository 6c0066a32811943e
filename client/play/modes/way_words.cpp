#include "client/play/modes/way_words.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "client/drawing/formatted.h"

namespace woodlouse::client {

core::Vec2 in_picture(core::Vec2 way, core::Vec2 up) {
  assert(std::abs(std::hypot(up.x, up.y) - 1.0) < 1e-6);
  return {core::cross(way, up), core::dot(way, up)};
}

std::string compass(core::Vec2 way, core::Vec2 up, Winds winds) {
  constexpr const char* kShort[] = {"east", "NE", "north", "NW", "west", "SW", "south", "SE"};
  constexpr const char* kSpoken[] = {"east", "north-east", "north", "north-west",
                                     "west", "south-west", "south", "south-east"};
  const core::Vec2 seen = in_picture(way, up);
  const long eighth = (std::lround(std::atan2(seen.y, seen.x) * (4.0 / std::numbers::pi)) + 8) % 8;
  return winds == Winds::kShort ? kShort[eighth] : kSpoken[eighth];
}

std::string way_text(core::Vec2 way, core::Vec2 up, Winds winds) {
  const double metres = std::hypot(way.x, way.y);
  return metres < 0.5 ? "here" : formatted("%s %.0f m", compass(way, up, winds).c_str(), metres);
}

}  // namespace woodlouse::client
