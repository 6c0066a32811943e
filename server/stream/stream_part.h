// A piece of a room's recording on its way to those who watch by inputs: whole lines, shared by all of them.
#pragma once

#include <cstdint>

#include "server/frames/line.h"

namespace woodlouse::server {

struct StreamPart {
  enum class Kind : std::uint8_t {
    kHeader,    ///< a game's first line; its keyframe follows
    kKeyframe,  ///< of tick `first`, which is `next`, too
    kSteps,     ///< the steps from `first` on, up to the one before `next`, each of them
  };
  Kind kind = Kind::kSteps;
  std::uint64_t first = 0, next = 0;  ///< [ticks]
  Line lines;
  bool is_answer = false;  ///< for one who asked, not for all
  bool is_last = false;    ///< none is on its way behind it: it waits for nothing. It alone may have no lines
};

}  // namespace woodlouse::server
