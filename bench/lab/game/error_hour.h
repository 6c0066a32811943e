// The error figure (shared/match/step_error.h) and the twin (twin.h) of an hour's play, minute by minute.
#pragma once

#include <cstddef>
#include <vector>

#include "bench/lab/game/scene.h"
#include "bench/lab/report/output.h"
#include "shared/core/error.h"

namespace woodlouse::lab {

/// Of six lice at 60 Hz, each steered by another one of kPlays.
struct ErrorMinute {
  double of_play = 0.0;       ///< the error figure of all [m/s of play]
  double share = 0.0;         ///< of the errors, that of the louse that erred most
  Play erring{};              ///< how that one was steered
  double worst = 0.0;         ///< bound of a tick's error [m]
  std::size_t windows = 0;    ///< of the twin that ended in it
  double apart_median = 0.0;  ///< how far it was away at their ends [m]
  double apart_most = 0.0;
  Play straying{};  ///< whose that was
};

/// The first so many minutes, by the map's own method.
std::vector<ErrorMinute> error_minutes(const map::Map& map, std::size_t minutes);

/// An hour on `volcano`, `hills`, `torus` and `jumps`. Writes lab-error-hour.csv and draws it.
core::Expected<void> measure_error_hour(const Output& output);

}  // namespace woodlouse::lab
