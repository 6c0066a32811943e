// Inputs that wait for their tick, ordered by (tick, player, seq): arrival order never changes a result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "shared/state/louse.h"

namespace woodlouse::match {

/// A player's thrust as the wire brought it, checked and rounded (protocol/codec.h).
struct Input {
  state::LouseId player = 0;
  std::uint32_t seq = 0;  ///< the player's own count, ascending
  state::Thrust thrust;
  std::uint32_t ticks = state::kHeld;  ///< how long it acts; kHeld: until the next input
  std::uint64_t wanted_tick = 0;  ///< the tick it asks for; 0, or one that is past: the next step takes it
};

/// An input as a step applied it; what the hash covers (40 bytes, no padding, in this order).
struct AppliedInput {
  state::LouseId player = 0;
  std::uint32_t seq = 0;
  core::Vec2 thrust;
  state::ThrustKind kind = state::ThrustKind::kNone;
  std::uint32_t ticks = 0;
  std::uint64_t tick = 0;
  friend bool operator==(const AppliedInput&, const AppliedInput&) = default;
};
static_assert(sizeof(AppliedInput) == 40);

/// What became of an input that was filed.
struct Filed {
  enum class Outcome {
    kFiled,      ///< step `tick` will apply it
    kStaleSeq,   ///< dropped: seq is not above the player's last one
    kQueueFull,  ///< dropped: the player has kMaxPending inputs waiting, or as many as that step takes
    kTooFar,     ///< dropped: more than 2 s ahead
    kNoLouse,    ///< dropped: the player has no louse
  };
  Outcome outcome = Outcome::kFiled;
  std::uint64_t tick = 0;
  bool late = false;  ///< the wanted tick was past; the next step takes it
  /// Of the player's input that gave way, as that step takes no more of his.
  std::optional<std::uint32_t> replaced{};
};

/// Who may file inputs, and the highest seq of his that was filed; nothing: none yet.
struct PlayerSeq {
  state::LouseId player = 0;
  std::optional<std::uint32_t> last_seq;
  friend bool operator==(const PlayerSeq&, const PlayerSeq&) = default;
};

class InputQueue {
 public:
  static constexpr std::size_t kMaxPending = 256;  ///< per player

  /// horizon: how many ticks ahead an input may ask for.
  explicit InputQueue(std::uint64_t horizon) : horizon_(horizon) {}

  void add_player(state::LouseId player) { players_.try_emplace(player); }
  void remove_player(state::LouseId player);
  /// Nobody steers any more: in those ticks, and behind his inputs that wait, comes one that ends his thrust.
  /// They stay, as a keyframe may have told of them. The first is `seq`; gives the one after the last. The
  /// cost is that of the ticks for which anything waits.
  std::uint32_t end_thrusts(state::LouseId player, std::uint32_t seq, std::set<std::uint64_t> ticks);
  /// next_tick: the step that will run next. per_tick: of a player's inputs for one step so many wait, the
  /// next one takes the place of the last: it would be overridden by it anyway. If that one has waited for a
  /// step already, a keyframe may have told of it: then the next one is dropped.
  Filed file(const Input& input, std::uint64_t next_tick, std::size_t per_tick = kMaxPending);
  /// Files an input that a step of the past is known to have applied, under its own tick; who waits there
  /// already stays. False: the player has no louse.
  bool file_applied(const AppliedInput& input);
  /// Moves the inputs of `tick` to `out` (cleared first), by (player, seq).
  void take(std::uint64_t tick, std::vector<AppliedInput>& out);

  [[nodiscard]] bool has_waiting() const { return !waiting_.empty(); }
  /// By ascending id; by (tick, player, seq).
  [[nodiscard]] std::vector<PlayerSeq> players() const;
  [[nodiscard]] std::vector<AppliedInput> waiting() const;
  /// Replaces everything by what those two gave. REQUIRES that `waiting` is of `players` alone.
  void restore(std::span<const PlayerSeq> players, std::span<const AppliedInput> waiting);

 private:
  /// False: there is one of that tick, player and seq already.
  bool wait(const AppliedInput& input);
  [[nodiscard]] bool ends_thrust(state::LouseId player, std::uint64_t tick) const;
  [[nodiscard]] std::set<std::uint64_t> ticks_waited_for(state::LouseId player) const;

  struct Player {
    std::uint32_t last_seq = 0;
    bool any = false;
    std::size_t pending = 0;
    std::uint64_t gap = 0;           ///< the next tick when he filed last
    std::uint32_t first_of_gap = 0;  ///< his first seq since that was the next tick
  };
  struct Key {
    std::uint64_t tick;
    state::LouseId player;
    std::uint32_t seq;
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  std::uint64_t horizon_;
  std::map<state::LouseId, Player> players_;
  std::map<Key, AppliedInput> waiting_;
  static constexpr std::size_t kMostSpare = 4096;
  /// Those that were taken, for as many to come: a game that goes on at its pace allocates nothing.
  std::vector<std::map<Key, AppliedInput>::node_type> spare_;
};

}  // namespace woodlouse::match
