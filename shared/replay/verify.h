// Re-runs a recording through the same match code and compares: the proof that a game was played as recorded.
//
// From keyframe to keyframe: the match is restored, the recorded roster changes and inputs are applied step
// by step, and of every step are demanded the same changes and inputs in the same order and the same state
// hash; of the next keyframe, the same bits. So a keyframe that a segment begins with is one that the segment
// before led to. After the first difference the re-run goes on to the next keyframe, to say which louse,
// which field and by how much.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "shared/core/error.h"
#include "shared/replay/rerun.h"
#include "shared/replay/source.h"

namespace woodlouse::replay {

struct Verification {
  std::uint64_t first_tick = 0;  ///< where it begins
  std::uint64_t ticks = 0;       ///< steps re-run up to the end, or to where the first difference showed
  /// It begins at tick 0, of which map and seed say all (Rerun::from_recorded). Else whoever wrote the first
  /// keyframe may have made it up, and what follows from it alone is proven: a fork's, or a recording whose
  /// beginning is missing.
  [[nodiscard]] bool from_start() const { return first_tick == 0; }
  bool cut_off = false;                  ///< the recording has no end line: the server did not finish it
  std::optional<Difference> difference;  ///< empty: the same bits throughout
  [[nodiscard]] bool ok() const { return !difference.has_value(); }
};

/// Re-runs a recording from its first line to its last, and once; the index plays no part but that it has to
/// tell what the lines before it do. Errors: a file that is no
/// recording, of another version or behavior, or damaged before its last line. parallel_verify.h: by several
/// threads.
core::Expected<Verification> verify(const ReplaySource& source);

/// The same a few seconds of the game at a time, for who tells meanwhile how far it is.
class Verifier {
 public:
  explicit Verifier(const ReplaySource& source);
  ~Verifier();
  Verifier(const Verifier&) = delete;
  Verifier& operator=(const Verifier&) = delete;

  /// On to the next keyframe. False: that was the last step. REQUIRES that it gave true so far.
  core::Expected<bool> advance();
  /// Whole once advance() gave false.
  [[nodiscard]] const Verification& verification() const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

/// One or two lines for people, newline included: `ok ticks 0 to 400`, and what of it is not proven, or where
/// and how it differs.
std::string to_text(const Verification& verification);

}  // namespace woodlouse::replay
