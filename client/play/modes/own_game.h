// What belongs to your own louse's part in a game besides its prediction: what the rules said of it, the
// ghosts it races, a gate of its own. Messages in, messages out; time is an argument. Single thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/play/modes/ghosts.h"
#include "client/play/modes/own_run.h"
#include "client/play/modes/private_gate.h"
#include "client/play/pilot.h"
#include "shared/map/map_definition.h"
#include "shared/protocol/messages.h"

namespace woodlouse::client {

class OwnGame {
 public:
  /// What the server can do.
  void take(const protocol::Hello& hello);
  /// A game begins; nothing is known of its map yet.
  void take(const protocol::Welcome& welcome);
  /// A ghost that was asked for; one that can't be driven here is none to race.
  void take(const protocol::GhostLine& ghost) { ghosts_.add_record(ghost); }
  /// An event of the room. A pilot where there is a louse of your own.
  void take(const protocol::Event& event, const protocol::Welcome& welcome, Pilot* pilot, core::Time now);
  /// The map has come, and is played by that mode.
  void begin(std::shared_ptr<const map::Map> map, std::uint32_t tick_hz, state::Mode mode);
  /// Runs on to now; the louse as it is drawn.
  void update(const Pilot& pilot, const LouseSample& louse, double tick, core::Time now);
  /// No louse is there: nothing to race against.
  void idle() { marks_.clear(); }

  /// A gate across the heading, where the louse is. What came of it, in words.
  std::string set_gate(const LouseSample& louse, core::Vec2 heading, core::Time now);

  /// To be sent, once.
  std::vector<protocol::ClientMessage> take_outgoing() { return std::exchange(outgoing_, {}); }

  [[nodiscard]] const OwnRun& run() const { return run_; }
  [[nodiscard]] Ghosts& ghosts() { return ghosts_; }
  [[nodiscard]] const std::vector<GhostMark>& ghost_marks() const { return marks_; }
  [[nodiscard]] const PrivateGate& gate() const { return gate_; }
  /// Of a race; 0: none is known.
  [[nodiscard]] std::uint64_t author_ms() const { return author_ms_; }

 private:
  void ask_for_ghost(protocol::Board board) {
    if (has_records_) outgoing_.emplace_back(protocol::GetGhost{board, 1});
  }

  std::shared_ptr<const map::Map> map_;  ///< null until it has come
  state::Mode mode_ = state::Mode::kRoam;
  bool has_records_ = false;  ///< the server has boards, or may have
  std::uint64_t author_ms_ = 0;
  OwnRun run_;
  Ghosts ghosts_;
  PrivateGate gate_;
  std::vector<GhostMark> marks_;
  std::vector<protocol::ClientMessage> outgoing_;
};

}  // namespace woodlouse::client
