// Everything this client knows of the room it is in: what the server said, merged and timed. Messages in,
// messages out; no socket, no terminal, and time is an argument.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/net/server_clock.h"
#include "client/net/server_word.h"
#include "client/net/tick_rate.h"
#include "client/play/keyframe_verifier.h"
#include "client/play/modes/own_game.h"
#include "client/play/pilot.h"
#include "client/play/roster.h"
#include "client/play/stream_view.h"
#include "client/play/trail.h"
#include "client/play/view_state.h"
#include "client/play/visible_lice.h"
#include "shared/core/clock.h"
#include "shared/core/error.h"
#include "shared/map/map_definition.h"
#include "shared/protocol/messages.h"

namespace woodlouse::client {

class RoomView {
 public:
  static constexpr std::chrono::milliseconds kDelay{100};  ///< how far behind the others are drawn
  static constexpr std::chrono::milliseconds kPingEvery{1000};
  static constexpr std::chrono::seconds kCountEvery{10};  ///< who looks on is counted anew so often
  static constexpr std::size_t kRoundTrips = 8;
  static constexpr std::chrono::milliseconds kResyncEvery{1000};  ///< asked for at most so often
  static constexpr std::chrono::milliseconds kNoticeFor{4000};
  static constexpr std::string_view kSkip = "/skip";

  /// One message of the server. Error: the server can't be played with (its map is unreadable); leave.
  core::Expected<void> on_message(const protocol::ServerMessage& message, core::Time now);
  /// A line of the room's recording, of who watches by inputs. False: it differs from what is re-run here,
  /// and none is taken any more.
  bool follow(std::string_view line, core::Time now);
  /// The line is cut: keeps the chat, the map and the picture with what its rules showed last, forgets the
  /// session. The next welcome says what became of the louse.
  void on_lost();
  /// Runs on to now: prediction, trails, pings. What is to be sent is in take_outgoing().
  void update(core::Time now);
  [[nodiscard]] std::vector<protocol::ClientMessage> take_outgoing();

  /// Chat; `/skip` is a vote for the room's next game.
  void say(std::string text) {
    if (text == kSkip) return outgoing_.emplace_back(protocol::Skip{}), void();
    outgoing_.emplace_back(protocol::Chat{std::move(text)});
  }
  /// What of the room is to be shown, where the server can show a part.
  void look(const protocol::View& view);
  /// Whether that is not everybody.
  [[nodiscard]] bool sees_part() const { return !looked_.is_whole(); }
  /// Seconds without a word of the server's, when they are too many: what is shown is no longer known.
  [[nodiscard]] std::optional<double> silence(core::Time now) const {
    return welcome_ ? word_.silence(now) : std::nullopt;
  }
  /// The room is paused: no tick passes.
  [[nodiscard]] bool stands() const { return welcome_ && word_.stands(); }
  void respawn() { outgoing_.emplace_back(protocol::Respawn{}); }
  /// A gate of your own where you are; what came of it is a notice.
  void set_gate(core::Time now);
  /// What the rules said of your louse, its ghosts and its gate.
  [[nodiscard]] OwnGame& own_game() { return own_game_; }
  [[nodiscard]] const OwnGame& own_game() const { return own_game_; }
  /// How often the bell was to be rung so far.
  [[nodiscard]] unsigned bells() const { return bells_; }
  /// A line over the key line for kNoticeFor.
  void notice(std::string text, core::Time now);

  [[nodiscard]] const protocol::Welcome* welcome() const { return welcome_ ? &*welcome_ : nullptr; }
  [[nodiscard]] const map::Map* map() const { return map_.get(); }
  [[nodiscard]] const Roster& roster() const { return roster_; }
  /// Null for a spectator and until the map is here.
  [[nodiscard]] Pilot* pilot() { return pilot_ ? &*pilot_ : nullptr; }
  [[nodiscard]] const Pilot* pilot() const { return pilot_ ? &*pilot_ : nullptr; }
  /// Every louse as of the last update, by id.
  [[nodiscard]] const std::map<std::uint32_t, Present>& lice() const { return lice_; }
  [[nodiscard]] Sight sight() const;
  /// The smallest of the last kRoundTrips: the others waited for something besides the network.
  [[nodiscard]] std::optional<double> rtt_seconds() const;
  /// The server's tick rate as its frames show it [Hz]; 0 before it can be known.
  [[nodiscard]] double measured_tick_hz() const { return rate_.hz(); }
  [[nodiscard]] const std::string& notice_line() const { return notice_; }
  /// What came of the keys' hashes, over all sessions; nothing verified unless asked for (make_join).
  [[nodiscard]] const KeyVerifier& verifier() const { return verifier_; }
  /// What came of the re-run, over all sessions; nothing where frames are watched.
  [[nodiscard]] const follow::Follower& follower() const { return stream_.follower(); }

 private:
  void take(const protocol::Welcome& welcome, core::Time now);
  core::Expected<void> take(const protocol::MapMessage& message);
  void take(const protocol::Frame& frame, core::Time now);
  void take(const protocol::Event& event, core::Time now);
  void take(const protocol::Pong& pong, core::Time now);
  void take(const protocol::Rooms& rooms);
  void goes_on(std::uint64_t tick, core::Time now);
  void begin_piloting();
  void draw_lice(core::Time now);

  std::optional<protocol::Welcome> welcome_;
  bool was_here_ = false;  ///< the line was cut since the last welcome
  std::shared_ptr<const map::Map> map_;
  std::optional<ServerClock> clock_;
  ServerWord word_;
  std::optional<ViewState> view_;  ///< stays when the line is cut, as mode_ and tick_hz_ do
  state::Mode mode_ = state::Mode::kRoam;
  std::uint32_t tick_hz_ = 60;
  KeyVerifier verifier_;
  StreamView stream_;
  std::optional<Pilot> pilot_;
  std::uint32_t last_seq_ = 0;  ///< of the connection's inputs, when the game began
  Roster roster_;
  std::map<std::uint32_t, Present> lice_;
  std::map<std::uint32_t, Trail> trails_;
  OwnGame own_game_;
  double shown_tick_ = 0.0;  ///< the server's, as of the last update
  std::vector<protocol::ClientMessage> outgoing_;
  protocol::View looked_;           ///< asked for last on this connection
  bool saw_part_ = false;           ///< when the line was cut
  std::deque<double> round_trips_;  ///< [s], the newest last
  std::optional<core::Time> pinged_;
  std::optional<core::Time> counted_;
  std::optional<core::Time> resync_asked_;
  TickRate rate_;
  unsigned bells_ = 0;
  std::string notice_;
  core::Time notice_until_{};
};

}  // namespace woodlouse::client
