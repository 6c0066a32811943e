// What a watcher by inputs sees of the room: the game that he re-runs himself (follow/follower.h), as the
// snapshots that pictures are made of.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "client/play/view_state.h"
#include "shared/follow/follower.h"
#include "shared/match/match.h"

namespace woodlouse::client {

/// Of the match between two steps.
Snapshot snapshot_of(const match::Match& match);

/// One line: where what the server sent parts from the re-run, and how.
std::string to_text(const replay::Difference& difference);

class StreamView {
 public:
  /// The next line of the stream. False: it differs from the re-run; nothing more is taken.
  bool take(std::string_view line) { return follower_.take(line); }
  /// Another game or session begins, shown so often a second.
  void begin(std::uint32_t tick_hz, std::uint32_t state_hz);

  /// The game; null before a keyframe.
  [[nodiscard]] const match::Match* match() const { return follower_.match(); }
  /// Whether the tick where it stands is one that goes out on time: those between come with it.
  [[nodiscard]] bool is_on_time() const { return match()->tick() % ticks_a_part_ == 0; }
  /// A snapshot of the game where it is worth one more: kPicturesHz of game time.
  std::optional<Snapshot> picture();

  /// Of all sessions.
  [[nodiscard]] const follow::Follower& follower() const { return follower_; }

 private:
  static constexpr std::uint32_t kPicturesHz = 30;

  follow::Follower follower_{"the server's stream"};
  std::uint64_t ticks_a_part_ = 1;
  std::uint64_t ticks_a_picture_ = 1;
  std::optional<std::uint64_t> pictured_;  ///< the tick of the last one
};

}  // namespace woodlouse::client
