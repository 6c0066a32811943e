// One recording being re-run: steps go in as they are read, the first difference comes out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shared/core/error.h"
#include "shared/map/map_definition.h"
#include "shared/match/match.h"
#include "shared/replay/replay_file.h"
#include "shared/replay/replayer.h"

namespace woodlouse::replay {

/// Files every input in the order of its player's seq, as the live game did. An input that asked for a later
/// tick than one of a higher seq was filed before that one, though its step comes after; so steps are run
/// only once the recording has been read as far ahead as an input may ask.
class Rerun {
 public:
  Rerun(std::shared_ptr<const map::Map> map, const match::MatchSettings& settings);

  /// Errors: the step or keyframe does not follow what came before. `place`: "FILE:LINE".
  core::Expected<void> add(StepLine line, const std::string& place);
  core::Expected<void> add(Keyframe keyframe, const std::string& place);
  /// Runs what is still waiting. No more may be added.
  void finish();

  /// Nothing more can be learned: the first difference and the keyframe after it are known.
  [[nodiscard]] bool is_settled() const { return difference_ && !difference_->detail.empty(); }
  [[nodiscard]] std::uint64_t steps_read() const { return steps_read_; }
  [[nodiscard]] std::uint64_t steps_run() const { return match_.tick(); }
  [[nodiscard]] const std::optional<Difference>& difference() const { return difference_; }

 private:
  struct Pending {
    match::StepRecord step;
    std::vector<match::AppliedInput>
        to_file;                       ///< its own inputs, and later steps' that were filed before them
    std::optional<Keyframe> keyframe;  ///< of the state after the step
  };

  bool file_earlier(const match::AppliedInput& input);
  void run_front();
  void apply_roster(const match::StepRecord& step);
  void file_inputs(std::vector<match::AppliedInput> inputs);
  void compare(const match::StepRecord& recorded, const match::StepRecord& rerun);
  void compare(const Keyframe& keyframe);
  void differ(std::uint64_t tick, std::string what);

  match::Match match_;
  std::uint64_t horizon_;                              ///< [ticks] how far ahead an input may ask
  std::deque<Pending> pending_;                        ///< at most horizon_ + 1
  std::map<match::PlayerId, std::uint32_t> last_seq_;  ///< the highest read
  match::PlayerId last_joined_ = 0;
  std::uint64_t steps_read_ = 0;
  std::optional<Difference> difference_;
};

/// The first louse and field in which the two differ, with both values in full; empty: the same bits.
std::string first_difference(std::span<const physics::Louse> recorded, std::span<const physics::Louse> rerun);

}  // namespace woodlouse::replay
