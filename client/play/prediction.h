// Your own louse before the server has answered: the server's World with one louse in it, from the exact
// state of the last ack, re-run with every input not yet acknowledged. Lice do not touch each other and the
// step is the same code, so an input that lands on the tick it asked for needs no correction at all, to the
// bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "client/controls/steering.h"
#include "client/play/shortest_way.h"
#include "shared/map/map_definition.h"
#include "shared/match/live_error.h"
#include "shared/physics/world.h"
#include "shared/protocol/messages.h"

namespace woodlouse::client {

class Prediction {
 public:
  static constexpr std::size_t kMaxPending = 256;  ///< inputs without an answer; the oldest are forgotten
  static constexpr std::uint64_t kMaxAheadTicks =
      600;  ///< further than this from the base nothing is run: start anew
  static constexpr std::size_t kHistory = 256;  ///< ticks whose positions are remembered

  /// REQUIRES a map in full detail, which has the mode.
  Prediction(const map::Map& map, std::uint32_t tick_hz, state::Mode mode = state::Mode::kRoam);

  /// An input was sent, asking for step `tick`. REQUIRES seq and tick above those before.
  void sent(std::uint32_t seq, std::uint64_t tick, const ThrustOrder& order);
  /// The server's answer: takes its exact state as the new base and re-runs to where the prediction was.
  void acknowledge(const protocol::Ack& ack);
  /// Runs on to the state before step `tick`; never back.
  void advance(std::uint64_t tick);
  /// From now on `error` is shown each tick before it is stepped, again where it is run again; null: nobody.
  void measure(std::shared_ptr<match::LiveError> error) { error_ = std::move(error); }
  [[nodiscard]] match::LiveError* error() const { return error_.get(); }
  /// Forgets the louse and all inputs: a respawn, a new session. The next ack begins anew.
  void forget();

  /// The louse before step tick(); null before the first ack.
  [[nodiscard]] const state::Louse* louse() const;
  [[nodiscard]] std::uint64_t tick() const { return tick_; }
  [[nodiscard]] std::size_t pending() const { return pending_.size(); }
  [[nodiscard]] state::Mode mode() const { return mode_; }
  [[nodiscard]] double step_seconds() const { return world_.step_seconds(); }
  /// Where it was, or was last believed to be, before step `tick`; nothing when that is forgotten.
  [[nodiscard]] std::optional<core::Vec2> position_at(std::uint64_t tick) const;
  /// How far the last ack moved what was already predicted: old minus new, the shorter way [m]. The drawing
  /// fades it out.
  [[nodiscard]] core::Vec2 take_correction();

 private:
  struct Pending {
    std::uint32_t seq;
    std::uint64_t tick;
    ThrustOrder order;
  };
  struct Past {
    std::uint64_t tick;
    core::Vec2 position;
  };

  void step();

  Ways ways_;
  state::Mode mode_;
  physics::World world_;
  std::optional<state::LouseId> id_;
  std::uint64_t tick_ = 0;
  std::deque<Pending> pending_;
  std::deque<Past> history_;  ///< ascending, without holes
  core::Vec2 correction_;
  std::shared_ptr<match::LiveError> error_;  ///< null: nobody asks
};

}  // namespace woodlouse::client
