// Your own louse: what you ask of it (steering), where it is before the server says so (prediction), and how
// far ahead of the server it lives.
//
// The lead: an input must reach the server before the step it asks for, so the louse is predicted one round
// trip and a margin ahead of the frames that arrive. The margin is learnt from the acks: `late` widens it at
// once, inputs that come earlier than needed narrow it slowly.
//
// On a big map the client has an overview, whose slopes are wrong by tens of per cent: a prediction from it
// would stray by more than a row's quantum within a few ticks and ask for an exact state several times a
// second. So nothing is predicted there, and the louse is drawn from the server's frames, kDelay behind, as
// all others are.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "client/controls/steering.h"
#include "client/net/server_clock.h"
#include "client/play/modes/drive.h"
#include "client/play/prediction.h"
#include "client/play/view_state.h"
#include "shared/core/clock.h"
#include "shared/protocol/messages.h"

namespace woodlouse::client {

/// How far ahead of arriving frames inputs are stamped. Pure.
class Lead {
 public:
  explicit Lead(double tick_hz) : tick_hz_(tick_hz) {}
  void observe(const protocol::Ack& ack);
  /// Ticks, for a round trip of `rtt_seconds`.
  [[nodiscard]] double ticks(double rtt_seconds) const { return rtt_seconds * tick_hz_ + margin_; }

 private:
  static constexpr double kTarget = 1.0;  ///< ticks an input should come early
  static constexpr double kSmallest = 0.5;
  static constexpr double kLargest = 30.0;

  double tick_hz_;
  double margin_ = 1.5;
};

class Pilot {
 public:
  /// Of a map that is an overview nothing is predicted: it is not the ground that is played on.
  /// last_seq: of the connection's inputs so far. REQUIRES a map that has the mode.
  Pilot(const map::Map& map, std::uint32_t tick_hz, std::uint32_t id, state::Mode mode = state::Mode::kRoam,
        std::uint32_t last_seq = 0);

  /// Runs the prediction on to now and says what to send, at most one input a tick.
  std::optional<protocol::Input> update(core::Time now, ServerClock& clock, double rtt_seconds);
  void acknowledge(const protocol::Ack& ack);
  /// The server's row of this louse: where it strays from what was predicted, an exact state is asked for.
  void compare(std::uint64_t tick, const LouseSample& row);
  /// What was predicted is worth nothing, the server having stood still: the next ack says where the louse
  /// is.
  void begin_anew();
  /// Back at a spawn point: the next ack says where.
  void respawned();
  /// What a louse at a spawn looks at first: at rest on a slope it would look where it rolls.
  void look_at(core::Vec2 place) { look_at_ = place; }

  /// The drive that a respawn has ended, once.
  std::optional<OwnDrive> take_drive() { return std::exchange(ended_, std::nullopt); }
  /// A lap of a race ended.
  void lap(std::uint64_t moments) { log_.lap(moments); }
  /// Ticks since the present drive began, as the louse is drawn; none before the first exact state.
  [[nodiscard]] std::optional<double> since_spawn() const {
    if (!log_.begun()) return std::nullopt;
    return std::max(0.0, ahead_ - static_cast<double>(*log_.begun()));
  }

  /// Null where nothing is predicted.
  [[nodiscard]] Prediction* prediction() { return prediction_ ? &*prediction_ : nullptr; }
  [[nodiscard]] bool predicts() const { return prediction_.has_value(); }
  Steering& steering() { return steering_; }
  [[nodiscard]] const Steering& steering() const { return steering_; }
  [[nodiscard]] std::uint32_t id() const { return id_; }
  [[nodiscard]] std::uint32_t last_seq() const { return seq_; }
  /// The louse as it is to be drawn now; nothing before the first exact state, and where nothing is
  /// predicted.
  [[nodiscard]] std::optional<LouseSample> sample() const;

 private:
  static constexpr double kStray = 0.05;        ///< [m]; quantized rows are finer than that
  static constexpr double kFadeSeconds = 0.08;  ///< in which a correction loses 63 % of its length
  static constexpr double kLargestFade = 2.0;   ///< [m]; a longer one is shown at once

  protocol::Input order(std::uint64_t tick, const ThrustOrder& wanted);
  void fade(core::Time now);

  std::uint32_t id_;
  Ways ways_;
  Steering steering_;
  std::optional<Prediction> prediction_;
  Lead lead_;
  std::uint32_t seq_;
  DriveLog log_;
  std::optional<OwnDrive> ended_;
  std::uint64_t last_tick_ = 0;  ///< the step the last input asked for
  double ahead_ = 0.0;           ///< fractional tick the louse is drawn at
  std::optional<core::Vec2> look_at_;
  bool heading_taken_ = false;       ///< the steering points where the louse does
  bool wants_state_ = true;          ///< ask for an exact state with the next input, wanted or not
  std::optional<core::Time> asked_;  ///< when
  core::Vec2 correction_;            ///< still to be faded out
  core::Time last_update_{};
};

}  // namespace woodlouse::client
