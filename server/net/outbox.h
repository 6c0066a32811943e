// What waits to be written to one client. State is replaceable, events and answers are not.
//
//   lines   events and answers, in order; more than `limit` bytes of them end the connection (overflow)
//   map     one answer to get_map: shared, of any length, so it has a place of its own
//   frames  one key and one delta at most; a stale one is replaced (frame_slots.h)
//   stream  of who watches by inputs, instead of frames (stream/stream_queue.h)
// Pure: no socket. One owner, no locking.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "server/net/frame_slots.h"
#include "server/stream/stream_queue.h"

namespace woodlouse::server {

class Outbox {
 public:
  /// limit: bytes of lines that may wait or be in flight (hello's outbox_bytes).
  explicit Outbox(std::size_t limit) : limit_(limit), stream_(limit / kStreamPart) {}

  enum class Push { kQueued, kOverflow };
  /// An event or answer. kOverflow: not queued, the client must be told `slow` and go.
  Push push(Line line);
  enum class Replaceable { kSent, kDropped };
  /// The last line: passes over the limit. replaceable: what becomes of the map and the frames that wait.
  void push_last(Line line, Replaceable replaceable);

  enum class PushMap { kQueued, kAlreadyWaiting };
  PushMap push_map(Line line);

  /// Of the stream; nothing after the last line.
  void follow(StreamPart part) {
    if (!closed_) stream_.put(std::move(part));
  }
  /// True once each time that the client has fallen behind and all that it was sent has left.
  bool take_wish() { return !closed_ && flying_bytes_ == 0 && stream_.take_wish(); }

  /// Another game begins: the map, the frames and the stream that wait are of the one before.
  void begin_anew();

  /// What waits rests on a key that holds other lice than the one of the same tick that comes.
  void forget_frames() { frames_ = FrameSlots(); }

  /// A key or a delta. kStale also after the last line.
  FrameSlots::Outcome offer(Frame frame);

  /// What one write sends; lines first, then the map, then frames, the stream, then the last line.
  struct Batch {
    std::vector<Line> lines;
    std::size_t frames = 0;  ///< how many of them are keys and deltas
    [[nodiscard]] bool empty() const { return lines.empty(); }
  };
  /// Everything that waits. REQUIRES that the batch before was written(); its memory is used again.
  Batch take(Batch written);
  Batch take() { return take(Batch()); }
  /// The batch taken last has left.
  void written();

  [[nodiscard]] std::size_t bytes() const { return waiting_bytes_ + flying_bytes_; }

 private:
  static constexpr std::size_t kStreamPart = 4;  ///< so much less of the stream's steps may wait

  std::size_t limit_;
  std::vector<Line> lines_;
  std::size_t waiting_bytes_ = 0;
  std::size_t flying_bytes_ = 0;
  Line map_;
  FrameSlots frames_;
  StreamQueue stream_;
  Line last_;
  bool closed_ = false;  ///< the last line was queued
};

}  // namespace woodlouse::server
