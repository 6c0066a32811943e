// At most one key and one delta that wait to go out: state is replaceable.
#pragma once

#include <optional>

#include "server/frames/frame.h"

namespace woodlouse::server {

/// The newest frames not yet sent. A key replaces whatever waits; a delta replaces a delta, never a key.
class FrameSlots {
 public:
  enum class Outcome {
    kStored,    ///< nothing was lost
    kReplaced,  ///< an unsent frame gave way
    kStale,     ///< not stored: a newer frame was here before
  };

  Outcome put(Frame frame);
  /// The key first, then the delta that rests on it; nothing when empty.
  std::optional<Frame> take();
  [[nodiscard]] bool empty() const { return !key_ && !delta_; }
  void clear() { key_.reset(), delta_.reset(); }

 private:
  std::optional<Frame> key_;
  std::optional<Frame> delta_;
  std::optional<std::uint64_t> newest_;      ///< tick of the newest frame seen
  std::optional<std::uint64_t> newest_key_;  ///< tick of the newest key seen
};

}  // namespace woodlouse::server
