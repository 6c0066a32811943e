// What of a room's recording waits to be written to one client who watches by inputs. Never a broken
// sequence: who falls behind is sent nothing more until a new keyframe comes, from which it goes on.
// Pure: no socket. One owner, no locking.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "server/stream/stream_part.h"

namespace woodlouse::server {

class StreamQueue {
 public:
  /// limit: bytes of steps that may wait; a keyframe may be of any length.
  explicit StreamQueue(std::size_t limit) : limit_(limit) {}

  /// A header or a keyframe takes the place of what waits. Steps are stored where they are the next ones:
  /// those that have been here are passed over, and where some are missing, or too many would wait, it falls
  /// behind.
  void put(StreamPart part);
  /// Another game begins.
  void begin_anew() { *this = StreamQueue(limit_); }
  /// All that waits, behind what is in `lines`.
  void take(std::vector<Line>& lines);

  /// True once each time it has fallen behind: the next keyframe is to be asked for when it has caught up.
  bool take_wish();
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  void fall_behind();

  std::size_t limit_;
  Line header_;  ///< not taken yet
  std::vector<Line> waiting_;
  std::size_t bytes_ = 0;             ///< of them
  std::optional<std::uint64_t> due_;  ///< the step to come; none: a keyframe has to come first
  bool wishes_ = false;
};

}  // namespace woodlouse::server
