// Hands a room's frames and events to those of its members that live on one lane, on that lane, a slice at a
// time: a big broadcast delays neither the tick nor other rooms.
//
// Events wait in their order, and all that wait go out together, one text for everybody; of frames at most
// the newest key and the newest delta wait (state is replaceable). Both take turns: however many events come,
// a frame that is due waits for one hand-out of them, a delta behind a key for two. Who watches by inputs is
// handed parts of the stream instead, all that wait together, in turns with frames. backlog() tells the room
// when events come faster than they go out, so that it refuses what would make more of them.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "server/frames/channels.h"
#include "server/room/lanes.h"
#include "server/room/subscriber.h"
#include "server/stream/stream_part.h"

namespace woodlouse::server {

/// Held by a shared_ptr: what it has posted keeps it until it ran.
class Broadcaster : public std::enable_shared_from_this<Broadcaster> {
 public:
  static constexpr std::size_t kSlice = 64;         ///< members served before others may run
  static constexpr std::size_t kMaxBacklog = 1024;  ///< events waiting, past which the room makes no more
  /// Parts of the stream waiting, past which all are dropped: who watches goes on from a new keyframe.
  static constexpr std::size_t kMostParts = 256;
  static constexpr std::size_t kBatchBytes = 32u
                                             << 10;  ///< of events handed out together, or one of any length

  explicit Broadcaster(const Lane& lane) : strand_(lane) {}

  struct Member {
    SessionId session = 0;
    std::shared_ptr<Subscriber> subscriber;
    ChannelId channel = 0;          ///< or kByInputs
    std::uint64_t first_event = 0;  ///< events numbered below came before it joined
  };

  // Any thread; in the order called. A member is called on the lane.
  void add(Member member);
  void remove(SessionId session);
  /// The member is shown that from now on.
  void change(SessionId session, ChannelId channel);
  void event(std::uint64_t number, Line line);
  /// Lets the member go when it has heard the events before this.
  void let_go(SessionId session);
  void frames(FrameKind kind, ChannelFrames frames);
  /// Of the stream. REQUIRES one of steps.
  void part(StreamPart part);
  /// Those that wait, and those that are being handed out, are of a game that is over; parts, too.
  void drop_frames();
  /// Events not yet handed out.
  [[nodiscard]] std::size_t backlog() const { return backlog_.load(std::memory_order_relaxed); }

 private:
  struct Event {
    std::uint64_t number = 0;
    Line line;  ///< none: no event, the session is let go
    SessionId session = 0;
  };
  /// Events that go out together.
  struct Batch {
    std::vector<Event> events;
    Line all;  ///< their lines, one behind the other
  };

  void wake();
  void hand_out_slice();
  bool begin_job();
  [[nodiscard]] Batch take_events();
  void let_those_go();
  void end_job();
  [[nodiscard]] bool has_job() const { return event_job_ || frame_job_ || !part_job_.empty(); }
  void serve(const Member& member) const;

  Lane strand_;
  std::atomic<std::size_t> backlog_{0};
  // The strand's:
  std::vector<Member> members_;  ///< subscriber null: removed during a job
  std::deque<Event> events_;
  std::optional<ChannelFrames> key_;
  std::optional<ChannelFrames> delta_;
  std::vector<StreamPart> parts_;
  std::optional<Batch> event_job_;  ///< the job being handed out, one of the three
  std::optional<ChannelFrames> frame_job_;
  std::vector<StreamPart> part_job_;
  bool is_frames_turn_ = false;  ///< events went out last
  bool is_parts_turn_ = true;    ///< of both, frames went out last
  std::size_t next_member_ = 0;  ///< of that job
  bool awake_ = false;           ///< a slice is posted
};

}  // namespace woodlouse::server
