// A drive of your own louse, kept so that it can be driven again: the exact state where it began and every
// input with the step that took it. Pure; single thread.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "client/controls/steering.h"
#include "shared/protocol/messages.h"
#include "shared/state/ghost.h"
#include "shared/state/louse.h"

namespace woodlouse::client {

struct OwnDrive {
  state::Louse start;
  std::vector<state::GhostInput> inputs;  ///< `at`: counted from the step that begins at `start`
  std::uint32_t ticks = 0;                ///< steps until it is over
  std::uint64_t lap = 0;                  ///< best lap of a race in it [moments]; 0: none
};

/// Of longer drives the beginning is kept.
inline constexpr std::uint32_t kMostDriveSeconds = 180;
inline constexpr std::size_t kMostDriveInputs = 5000;

class DriveLog {
 public:
  explicit DriveLog(std::uint32_t tick_hz) : most_ticks_(kMostDriveSeconds * tick_hz) {}

  /// An input goes out; what became of it an ack says.
  void sent(std::uint32_t seq, const ThrustOrder& order) {
    pending_.emplace_back(seq, order);
    if (pending_.size() > kMostPending) pending_.pop_front();
  }
  void acknowledged(const protocol::Ack& ack) {
    std::optional<ThrustOrder> order;
    while (!pending_.empty() && pending_.front().first <= ack.seq) {
      if (pending_.front().first == ack.seq) order = pending_.front().second;
      pending_.pop_front();
    }
    if (ack.dropped) return;
    if (!begun_) {
      if (!ack.you) return;
      drive_ = {ack.you->louse, {}, 0, 0};
      begun_ = ack.you->tick;
      return;  // its state has taken the input already
    }
    if (!order || ack.tick < *begun_) return;
    const std::uint64_t at = ack.tick - *begun_;
    if (at < most_ticks_ && drive_.inputs.size() < kMostDriveInputs)
      drive_.inputs.push_back({static_cast<std::uint32_t>(at), order->thrust, order->ticks});
  }
  /// A lap of a race was driven.
  void lap(std::uint64_t moments) {
    if (drive_.lap == 0 || moments < drive_.lap) drive_.lap = moments;
  }

  /// Ends it before step `tick` and begins anew with the next state; nothing where there is no drive.
  std::optional<OwnDrive> finish(std::uint64_t tick) {
    const auto begun = std::exchange(begun_, std::nullopt);
    if (!begun || tick <= *begun) return std::nullopt;
    drive_.ticks = static_cast<std::uint32_t>(std::min<std::uint64_t>(tick - *begun, most_ticks_));
    return std::move(drive_);
  }
  /// The tick at which the present one began.
  [[nodiscard]] std::optional<std::uint64_t> begun() const { return begun_; }

 private:
  static constexpr std::size_t kMostPending = 256;

  std::uint64_t most_ticks_;
  std::deque<std::pair<std::uint32_t, ThrustOrder>> pending_;
  std::optional<std::uint64_t> begun_;
  OwnDrive drive_;
};

}  // namespace woodlouse::client
