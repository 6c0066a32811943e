// One segment of a recording being re-run: restored from a keyframe, step after step as recorded, and at each
// the question whether it went as recorded.
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "shared/core/error.h"
#include "shared/map/map_definition.h"
#include "shared/match/match.h"
#include "shared/replay/format.h"

namespace woodlouse::replay {

/// Where a recording and its re-run part.
struct Difference {
  std::uint64_t tick = 0;  ///< the first tick whose state, or the step whose inputs, differ
  std::string what;        ///< the hashes, or the roster change or input that was applied otherwise
  std::string detail;      ///< from the next keyframe: louse, field, both values; or why it says nothing
};

class Rerun {
 public:
  /// Errors: the keyframe is none of that map, its hash is not that of what it holds, too many lice. `place`:
  /// "FILE:LINE".
  static core::Expected<std::unique_ptr<Rerun>> from(std::shared_ptr<const map::Map> map,
                                                     const match::MatchSettings& settings, Keyframe keyframe,
                                                     const std::string& place);

  /// The same of a keyframe that stands in a recording: one of tick 0 is the beginning of a game of that map
  /// and seed, in every field (a live match at tick 0 may have joins behind it). Errors: as from(), or it is
  /// not.
  static core::Expected<std::unique_ptr<Rerun>> from_recorded(std::shared_ptr<const map::Map> map,
                                                              const match::MatchSettings& settings,
                                                              Keyframe keyframe, const std::string& place);

  /// Performs the step as recorded; nothing: it went so. Errors: it can't follow what came before.
  core::Expected<std::optional<Difference>> step(const StepLine& line, const std::string& place);
  /// Performs as many of the `most` steps to come as are known to do nothing (Match::stand_still); how many.
  std::uint64_t stand_still(std::uint64_t most);
  /// What of the keyframe is otherwise than here: "louse 3, x: .. recorded, .. re-run"; empty: nothing.
  /// REQUIRES keyframe.state.tick == match().tick().
  [[nodiscard]] std::string difference_to(const Keyframe& keyframe) const;

  [[nodiscard]] const match::Match& match() const { return *match_; }
  /// The last step as it went here, with what the rules said of it; until the next one. REQUIRES a step().
  [[nodiscard]] const match::StepRecord& last() const {
    assert(last_ != nullptr);
    return *last_;
  }

 private:
  explicit Rerun(std::unique_ptr<match::Match> match, match::PlayerId last_joined)
      : match_(std::move(match)), last_joined_(last_joined) {}

  std::unique_ptr<match::Match> match_;
  match::PlayerId last_joined_;
  const match::StepRecord* last_ = nullptr;  ///< the match's own
};

/// The first louse and field in which the two differ, with both values in full; empty: the same bits.
std::string first_difference(std::span<const state::Louse> recorded, std::span<const state::Louse> rerun);

}  // namespace woodlouse::replay
