// A recording being played: stands at a tick, steps forth with the recorded inputs, jumps anywhere, and says
// of every tick whether the re-run's hash is the recorded one.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "shared/core/error.h"
#include "shared/match/match.h"
#include "shared/replay/byte_stream.h"
#include "shared/replay/line_reader.h"
#include "shared/replay/rerun.h"

namespace woodlouse::replay {

class ReplayArchive;

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
  /// Where the re-run first parted from the recording since the last jump's keyframe, when it did.
  [[nodiscard]] const std::optional<Difference>& first_difference() const { return first_difference_; }
  /// The keyframe that the last jump restored: what is shown is proven since there.
  [[nodiscard]] std::uint64_t proven_since() const { return proven_since_; }

 private:
  friend class ReplayArchive;
  explicit Playback(std::shared_ptr<const ReplayArchive> archive);

  core::Expected<void> restore(std::size_t keyframe);
  core::Expected<void> pass(const Keyframe& keyframe);

  std::shared_ptr<const ReplayArchive> archive_;
  std::unique_ptr<InputStream> stream_;
  std::unique_ptr<ReplayReader> reader_;
  std::unique_ptr<Rerun> rerun_;
  std::optional<Difference> first_difference_;
  std::uint64_t proven_since_ = 0;
};

}  // namespace woodlouse::replay
