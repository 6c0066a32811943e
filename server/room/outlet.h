// The way out of a room: its frames are encoded here, beside its ticks, and they and its events are handed to
// its members on their lanes (broadcaster.h). What waits to be encoded is the newest snapshot alone: who is
// behind skips frames, and a tick never waits for one.
#pragma once

#include <boost/asio/strand.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "server/frames/channels.h"
#include "server/frames/snapshot.h"
#include "server/room/broadcaster.h"
#include "server/room/lanes.h"
#include "server/stream/input_stream.h"

namespace woodlouse::server {

/// Held by a shared_ptr: what it has posted keeps it until it ran.
class Outlet : public std::enable_shared_from_this<Outlet> {
 public:
  explicit Outlet(const Lanes& lanes);

  // One thread at a time, a room's strand; what is called takes effect in that order.

  /// REQUIRES that the channel is not open.
  void open(ChannelId channel, RowLayout layout);
  /// Nobody has it any more.
  void close(ChannelId channel);
  /// The newest frames of an open channel, out of turn; encoded from `now` where there are none.
  void show_newest(ChannelId channel, std::shared_ptr<Subscriber> subscriber, SharedSnapshot now);
  void add(Broadcaster::Member member);
  void remove(SessionId session, std::size_t lane);
  void event(std::uint64_t number, Line line);
  void let_go(SessionId session, std::size_t lane);
  void show(FrameKind kind, SharedSnapshot now);
  /// What is to be shown is, before anything that is called after this.
  void flush();
  /// Who is a member is shown frames or, of kByInputs, the stream.
  void change(SessionId session, std::size_t lane, ChannelId channel);

  /// Of the stream, for who watches by inputs: the step just done. goes_out: with what waits; none: not yet.
  void show_step(SharedStep step, std::optional<InputStream::Quiet> goes_out);
  /// Those that wait go out, and at once: none is on its way behind them.
  void show_steps_left();
  /// Where the steps led, kept for so many ticks. REQUIRES that the step that led there was shown.
  void keep_keyframe(match::MatchState state, std::uint64_t kept_ticks);
  /// The keyframe kept, behind the game's header where there is one, and what came since. REQUIRES one.
  void show_keyframe(std::shared_ptr<Subscriber> subscriber, Line header);

  /// Till all that was asked before is done.
  void keep(std::shared_ptr<const void> what);
  /// Another game begins: no frame of the one before goes to anybody after this.
  void begin_anew();
  /// Made and said behind all frames of the game before. divisor: Subscriber::welcome()'s.
  void welcome(std::shared_ptr<Subscriber> subscriber, std::function<protocol::Welcome()> make,
               std::uint32_t divisor);

  // Any thread:

  /// Events not yet handed out, on the lane where most wait.
  [[nodiscard]] std::size_t backlog() const;
  [[nodiscard]] std::uint64_t frames_encoded() const { return encoded_.load(std::memory_order_relaxed); }

 private:
  void encode();
  void hand_out(std::optional<StreamPart> part);

  boost::asio::strand<boost::asio::io_context::executor_type> strand_;
  std::vector<std::shared_ptr<Broadcaster>> lanes_;
  std::atomic<std::uint64_t> encoded_{0};
  std::atomic<std::size_t> events_{0};  ///< on their way to the lanes
  // The strand's:
  InputStream stream_;
  Channels channels_;
  SharedSnapshot due_;  ///< to be encoded; none: nothing is
  FrameKind due_kind_ = FrameKind::kDelta;
};

}  // namespace woodlouse::server
