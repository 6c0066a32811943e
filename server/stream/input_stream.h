// A room's recording as it is written, for those who watch by inputs: a keyframe where somebody comes or has
// fallen behind, then every step's line. Lines go out together, a part for all; the newest keyframe and what
// came since are kept for a while, so that many who come at once cost one keyframe.
// Pure: no socket, no clock. One owner, no locking.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/stream/recorded_step.h"
#include "server/stream/stream_part.h"
#include "shared/match/match_state.h"

namespace woodlouse::server {

class InputStream {
 public:
  /// Another game begins: what was not taken is nobody's.
  void begin_anew();
  /// The next one. After steps that it was not told of, what was not taken yet is nobody's.
  void step(const RecordedStep& step);

  enum class Quiet : std::uint8_t {
    kHeldBack,  ///< steps that did nothing and stand last are not told yet: one line may tell more of them
    kTold,
  };
  /// The lines since the last part; nothing: there are none.
  std::optional<StreamPart> take(Quiet quiet);

  /// The state where the steps led, kept for so many ticks. What waits for steps to come is left out: who
  /// watches knows no input before its step. REQUIRES that all was taken, and that state.roster is empty.
  void keyframe(match::MatchState state, std::uint64_t kept_ticks);
  /// The keyframe, and what was taken since. REQUIRES that it is kept.
  [[nodiscard]] std::vector<StreamPart> newest() const;

 private:
  void put_quiet();
  void keep(const StreamPart& part);

  std::string lines_;  ///< not taken yet, of the steps from first_ on
  std::uint64_t first_ = 0, next_ = 0;
  std::uint64_t quiet_ = 0;            ///< steps of these, the last ones, that have no line yet
  std::optional<std::uint64_t> hash_;  ///< of the step or keyframe before; none: not known
  std::vector<StreamPart> kept_;       ///< empty: none
  std::uint64_t kept_until_ = 0;
  LinePool pool_;
};

}  // namespace woodlouse::server
