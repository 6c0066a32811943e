// What the terminal's bell is rung for, where the player wants it.
#pragma once

#include "shared/protocol/messages.h"

namespace woodlouse::client {

/// Whether your louse `you` fell, holds the place now, ended a run or drove a record. Pure.
inline bool rings(const protocol::Event& event, std::uint32_t you) {
  if (you == 0 || event.id != you) return false;
  switch (event.kind) {
    case protocol::EventKind::kFell:
    case protocol::EventKind::kHolds:
    case protocol::EventKind::kRun:
    case protocol::EventKind::kRecord:
      return true;
    default:
      return false;
  }
}

}  // namespace woodlouse::client
