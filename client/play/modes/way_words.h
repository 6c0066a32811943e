// Directions and ways, as they are named to the player.
#pragma once

#include <cstdint>
#include <string>

#include "shared/core/vec2.h"

namespace woodlouse::client {

enum class Winds : std::uint8_t {
  kShort,   ///< "NE", "west": a letter alone would be read as a key, or as a gate
  kSpoken,  ///< "north-east", "west"
};

/// What of a way leads right and up in a picture in which `up` points up; length 1.
core::Vec2 in_picture(core::Vec2 way, core::Vec2 up);
/// One of eight directions. North is `up`: in a picture that is turned the words name the keys that push
/// there.
std::string compass(core::Vec2 way, core::Vec2 up = {0.0, 1.0}, Winds winds = Winds::kShort);
/// "NE 27 m"; "here" below half a metre.
std::string way_text(core::Vec2 way, core::Vec2 up, Winds winds = Winds::kShort);

}  // namespace woodlouse::client
