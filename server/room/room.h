// One game: a strand, a timer on an absolute schedule, a match. Its ticks run in a context of their own, so
// that they never queue behind the sockets' work; frames and events leave through the broadcaster.
//
// One tick: bots look, the match steps, the recorder gets the step, inputs are acknowledged, every
// tick_hz / state_hz ticks a frame is encoded and handed over.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/system/error_code.hpp>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "server/room/broadcaster.h"
#include "server/room/channels.h"
#include "server/room/figures.h"
#include "server/room/pending_acks.h"
#include "server/room/seats.h"
#include "server/room/start.h"
#include "server/room/subscriber.h"
#include "server/room/tick_clock.h"
#include "server/watchers/ground_ahead.h"
#include "server/watchers/recorder.h"
#include "server/watchers/shadow.h"
#include "shared/match/match.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

struct RoomSettings {
  std::string name;
  std::uint32_t state_hz = 20;              ///< divides the match's tick_hz
  std::uint32_t bots = 0;                   ///< of the house
  std::optional<std::uint64_t> tick_limit;  ///< ends after so many
  std::uint32_t per_room = 1024;            ///< members at most, the house's bots apart
};

/// Who works beside a room's game; each may be null.
struct RoomStaff {
  std::unique_ptr<Recorder> recorder;
  std::unique_ptr<Shadow> shadow;
  std::unique_ptr<GroundAhead> ahead;  ///< null where the map is in memory as a whole
};

class Room {
 public:
  /// ticks: where the room's strand lives; io: where its broadcaster lives.
  Room(boost::asio::io_context& ticks, boost::asio::io_context& io, RoomSettings settings, Opening opening,
       RoomStaff staff, std::shared_ptr<spdlog::logger> log);

  // Any thread. Calls of one thread take effect in their order.

  /// The first tick is due now. ended: called once, on the room's strand, when the tick limit is reached.
  void start(std::function<void()> ended);
  /// Ends the ticks, says bye to the members, finishes the recording; then calls `stopped`, on some thread.
  void stop(const protocol::Bye& bye, const std::string& reason, std::function<void()> stopped);
  /// Answered by welcome() and frames, or refuse_join().
  void join(SessionId session, std::shared_ptr<Subscriber> subscriber, protocol::Join join);
  /// A message of a session that asked to join. arrived: when its line was read.
  void submit(SessionId session, protocol::ClientMessage message, Time arrived);
  /// The session is gone: its thrust ends and its louse goes.
  void leave(SessionId session);

  [[nodiscard]] const std::string& name() const { return settings_.name; }
  /// How many there are, as of now.
  [[nodiscard]] protocol::RoomEntry census() const;
  /// REQUIRES that the room has stopped.
  [[nodiscard]] const RoomMetrics& metrics() const { return metrics_; }

 private:
  using Strand = boost::asio::strand<boost::asio::io_context::executor_type>;

  void arm_timer();
  void on_timer(const boost::system::error_code& error);
  void tick(Time now);
  void steer_house_bots();
  void record_step(const match::StepRecord& step, Time begun, const std::vector<PendingAck>& acks);
  void send_acks(std::uint64_t tick, Time begun, const std::vector<PendingAck>& acks);
  void send_frames();
  void begin_recording();
  void finish_staff(const std::string& reason, std::function<void()> stopped);
  void add_house_bots();
  void look_ahead();

  void admit(SessionId session, std::shared_ptr<Subscriber> subscriber, const protocol::Join& join);
  std::optional<protocol::ErrorMessage> why_not() const;
  match::PlayerId give_louse(Member& member);
  protocol::Welcome welcome_for(const Member& member, const protocol::Join& join,
                                std::uint32_t state_hz) const;
  void remove(SessionId session);

  void on_message(SessionId session, Member& member, const protocol::Input& input, Time arrived);
  void on_message(Member& member, const protocol::Chat& chat);
  void on_message(Member& member, const protocol::GetMap&);
  void on_message(Member& member, const protocol::Resync&);
  void on_message(Member& member, const protocol::Respawn&);
  void drop_input(Member& member, const protocol::Input& input, const match::Filed& filed);
  bool refuse_when_busy(Member& member) const;
  void emit(protocol::Event event);
  void count(protocol::Role role, std::int32_t change);
  [[nodiscard]] Scene scene() const;

  RoomSettings settings_;
  std::shared_ptr<spdlog::logger> log_;
  Strand strand_;
  boost::asio::steady_timer timer_;
  std::unique_ptr<Recorder> recorder_;
  std::unique_ptr<Shadow> shadow_;
  Broadcaster broadcaster_;
  Line map_line_;
  std::atomic<std::uint32_t> players_{0}, bots_{0}, spectators_{0};

  // The strand's:
  std::unique_ptr<match::Match> match_owner_;
  match::Match& match_ = *match_owner_;
  std::uint32_t tick_hz_;
  std::string map_file_;
  std::optional<replay::Parent> parent_;
  std::unique_ptr<GroundAhead> ahead_;
  std::optional<TickClock> clock_;
  Roster roster_;
  AckBook acks_;
  FrameChannels channels_;
  std::uint64_t next_event_ = 1;
  std::function<void()> ended_;
  enum class State { kWaiting, kRunning, kStopped } state_ = State::kWaiting;
  RoomMetrics metrics_;
};

}  // namespace woodlouse::server
