// What is known so far of how far a louse's steps err (live_error.h), as it is shown.
#pragma once

#include <cstdint>

namespace woodlouse::match {

struct ErrorReading {
  double seconds = 0.0;          ///< of play that was counted, > 0
  double of_play = 0.0;          ///< the error figure [m/s of play]
  double worst = 0.0;            ///< bound of one tick's error [m]
  std::uint64_t worst_tick = 0;  ///< the first tick that erred so
  double apart = 0.0;            ///< how far a twin at half the step was away [m]
  double apart_seconds = 0.0;    ///< after so long: Twin::kSeconds, or less until it first was away for that
};

}  // namespace woodlouse::match
