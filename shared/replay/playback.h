// A recording being played: stands at a tick, steps forth with the recorded inputs, jumps anywhere, and says
// of every tick whether the re-run's hash is the recorded one.
#pragma once

#include <cstdint>
#include <istream>
#include <memory>
#include <optional>
#include <vector>

#include "shared/core/error.h"
#include "shared/match/match.h"
#include "shared/replay/line_reader.h"

namespace woodlouse::replay {

class ReplayArchive;
class Rerun;

/// What one step forth did.
struct PlayedStep {
  StepLine recorded;            ///< the roster changes and inputs applied, and the recorded hash
  std::vector<ChatLine> chats;  ///< said since the step before
  std::uint64_t hash = 0;       ///< of the re-run; recorded.step.hash where the two are the same
  [[nodiscard]] bool is_proven() const { return hash == recorded.step.hash; }
};

/// Not thread safe: one thread at a time.
class Playback {
 public:
  ~Playback();
  Playback(const Playback&) = delete;
  Playback& operator=(const Playback&) = delete;

  /// The state before step tick().
  [[nodiscard]] const match::Match& match() const;
  [[nodiscard]] std::uint64_t tick() const { return match().tick(); }
  /// Performs the next recorded step; nothing at the end. Errors: the file is damaged here.
  core::Expected<std::optional<PlayedStep>> advance();
  /// Goes to any tick of the recording, forth or back; at most kKeyframeSeconds are re-run. After an error
  /// the playback stands somewhere else in the recording, but whole.
  core::Expected<void> seek(std::uint64_t tick);
  /// The first tick whose hash differed since the last jump's keyframe, when one did.
  [[nodiscard]] std::optional<std::uint64_t> first_difference() const { return first_difference_; }

 private:
  friend class ReplayArchive;
  explicit Playback(std::shared_ptr<const ReplayArchive> archive);

  core::Expected<void> restore(std::size_t keyframe);

  std::shared_ptr<const ReplayArchive> archive_;
  std::unique_ptr<std::istream> stream_;
  std::unique_ptr<ReplayReader> reader_;
  std::unique_ptr<Rerun> rerun_;
  std::optional<std::uint64_t> first_difference_;
};

}  // namespace woodlouse::replay
