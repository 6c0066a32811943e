#include "shared/replay/rerun.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <span>
#include <type_traits>
#include <utility>

#include "shared/core/joined.h"
#include "shared/json/text.h"
#include "shared/replay/louse_fields.h"

namespace woodlouse::replay {
namespace {

using core::joined;

std::string both(std::string_view recorded, std::string_view rerun) {
  return joined({recorded, " recorded, ", rerun, " re-run"});
}

std::string name_of(const match::AppliedInput& input) {
  return joined({"player ", std::to_string(input.player), " seq ", std::to_string(input.seq)});
}

std::string name_of(const match::RosterChange& change) {
  constexpr std::string_view kNames[] = {"join of ", "leave of ", "respawn of "};
  return joined({kNames[static_cast<std::size_t>(change.action)], "player ", std::to_string(change.player)});
}

std::string_view reason(match::Filed::Outcome outcome) {
  using Outcome = match::Filed::Outcome;
  switch (outcome) {
    case Outcome::kFiled:
      return "filed";
    case Outcome::kStaleSeq:
      return "its seq is not above the player's last one";
    case Outcome::kQueueFull:
      return "too many inputs of the player wait";
    case Outcome::kTooFar:
      return "it asks for a step too far ahead";
    case Outcome::kNoLouse:
      return "the player has no louse";
  }
  assert(false);
  return {};
}

/// Names of the first entries that are not the same; what is missing on one side is "none".
template <typename T>
std::string first_unlike(const std::vector<T>& recorded, const std::vector<T>& rerun) {
  for (std::size_t k = 0; k < std::max(recorded.size(), rerun.size()); ++k) {
    const T* a = k < recorded.size() ? &recorded[k] : nullptr;
    const T* b = k < rerun.size() ? &rerun[k] : nullptr;
    if (a != nullptr && b != nullptr && *a == *b) continue;
    return both(a != nullptr ? name_of(*a) : "none", b != nullptr ? name_of(*b) : "none");
  }
  return {};
}

struct FieldText {
  std::string_view name;
  std::uint64_t bits = 0;
  std::string text;
};

std::vector<FieldText> field_texts(const physics::Louse& louse) {
  std::vector<FieldText> result;
  visit_fields(louse, [&](std::string_view name, const auto& field) {
    using Field = std::remove_cvref_t<decltype(field)>;
    if constexpr (std::is_same_v<Field, double>) {
      result.push_back({name, std::bit_cast<std::uint64_t>(field), json::double_text(field)});
    } else {
      const auto value = static_cast<std::uint32_t>(field);
      result.push_back({name, value, std::to_string(value)});
    }
  });
  return result;
}

}  // namespace

std::string first_difference(std::span<const physics::Louse> recorded,
                             std::span<const physics::Louse> rerun) {
  std::size_t k = 0;
  for (; k < recorded.size() && k < rerun.size() && recorded[k].id == rerun[k].id; ++k) {
    const std::vector<FieldText> a = field_texts(recorded[k]);
    const std::vector<FieldText> b = field_texts(rerun[k]);
    for (std::size_t f = 0; f < a.size(); ++f) {
      if (a[f].bits == b[f].bits) continue;
      return joined(
          {"louse ", std::to_string(recorded[k].id), ", ", a[f].name, ": ", both(a[f].text, b[f].text)});
    }
  }
  if (k == recorded.size() && k == rerun.size()) return {};
  const bool only_recorded = k == rerun.size() || (k < recorded.size() && recorded[k].id < rerun[k].id);
  const physics::LouseId id = only_recorded ? recorded[k].id : rerun[k].id;
  return joined(
      {"louse ", std::to_string(id), only_recorded ? " is only in the recording" : " is only in the re-run"});
}

Rerun::Rerun(std::shared_ptr<const map::Map> map, const match::MatchSettings& settings)
    : match_(std::move(map), settings), horizon_(match::kHorizonSeconds * std::uint64_t{settings.tick_hz}) {}

core::Expected<void> Rerun::add(StepLine line, const std::string& place) {
  if (line.step.tick != steps_read_) {
    return core::fail(place,
                      joined({"step ", std::to_string(line.step.tick), " stands where step ",
                              std::to_string(steps_read_), " is due"}),
                      "lines are missing or out of order");
  }
  for (const match::RosterChange& change : line.step.roster) {
    if (change.action != match::RosterAction::kJoin) continue;
    if (change.player <= last_joined_) {
      return core::fail(place,
                        joined({"player ", std::to_string(change.player), " joins after player ",
                                std::to_string(last_joined_)}),
                        "ids ascend and are never used again");
    }
    last_joined_ = change.player;
  }
  ++steps_read_;
  std::vector<match::AppliedInput> to_file;
  for (const match::AppliedInput& input : line.step.inputs) {
    const auto [last, is_first] = last_seq_.try_emplace(input.player, input.seq);
    const bool is_overtaken = !is_first && input.seq < last->second;
    last->second = std::max(last->second, input.seq);
    if (!is_overtaken || !file_earlier(input)) to_file.push_back(input);
  }
  pending_.push_back({std::move(line.step), std::move(to_file), std::nullopt});
  if (pending_.size() > horizon_ + 1) run_front();
  return {};
}

core::Expected<void> Rerun::add(Keyframe keyframe, const std::string& place) {
  if (pending_.empty() || keyframe.tick != steps_read_ || pending_.back().keyframe) {
    return core::fail(place, joined({"a keyframe of tick ", std::to_string(keyframe.tick),
                                     " stands where tick ", std::to_string(steps_read_), " is reached"}));
  }
  pending_.back().keyframe = std::move(keyframe);
  return {};
}

void Rerun::finish() {
  while (!pending_.empty()) run_front();
  if (difference_ && difference_->detail.empty()) {
    difference_->detail = "no keyframe follows that could say which louse";
  }
}

/// Has the input filed with the first waiting step that has a higher seq of its player. Without one it is
/// filed with its own step, and the match will refuse it.
bool Rerun::file_earlier(const match::AppliedInput& input) {
  const auto overtakes = [&](const match::AppliedInput& other) {
    return other.player == input.player && other.seq > input.seq;
  };
  const auto first = std::find_if(pending_.begin(), pending_.end(), [&](const Pending& pending) {
    return std::any_of(pending.step.inputs.begin(), pending.step.inputs.end(), overtakes);
  });
  if (first == pending_.end()) return false;
  first->to_file.push_back(input);
  return true;
}

void Rerun::run_front() {
  Pending pending = std::move(pending_.front());
  pending_.pop_front();
  if (is_settled()) return;
  apply_roster(pending.step);
  file_inputs(std::move(pending.to_file));
  compare(pending.step, match_.advance());
  if (pending.keyframe) compare(*pending.keyframe);
}

void Rerun::apply_roster(const match::StepRecord& step) {
  for (const match::RosterChange& change : step.roster) {
    switch (change.action) {
      case match::RosterAction::kJoin:
        match_.join_as(change.player);
        break;
      case match::RosterAction::kLeave:
        match_.leave(change.player);
        break;
      case match::RosterAction::kRespawn:
        match_.respawn(change.player);
        break;
    }
  }
}

void Rerun::file_inputs(std::vector<match::AppliedInput> inputs) {
  std::stable_sort(inputs.begin(), inputs.end(), [](const auto& a, const auto& b) {
    return std::pair(a.player, a.seq) < std::pair(b.player, b.seq);
  });
  for (const match::AppliedInput& input : inputs) {
    const match::Filed filed =
        match_.file({input.player, input.seq, {input.kind, input.thrust}, input.ticks, input.tick});
    if (filed.outcome == match::Filed::Outcome::kFiled) continue;
    differ(input.tick,
           joined({"the input of ", name_of(input), " can't be applied: ", reason(filed.outcome)}));
  }
}

void Rerun::compare(const match::StepRecord& recorded, const match::StepRecord& rerun) {
  if (recorded.roster != rerun.roster) {
    differ(recorded.tick, joined({"roster of step ", std::to_string(recorded.tick), ": ",
                                  first_unlike(recorded.roster, rerun.roster)}));
  }
  if (recorded.inputs != rerun.inputs) {
    differ(recorded.tick, joined({"inputs of step ", std::to_string(recorded.tick), ": ",
                                  first_unlike(recorded.inputs, rerun.inputs)}));
  }
  if (recorded.hash != rerun.hash) {
    differ(recorded.tick + 1, joined({"hash ", both(core::to_hex(recorded.hash), core::to_hex(rerun.hash))}));
  }
}

void Rerun::compare(const Keyframe& keyframe) {
  const std::string found = first_difference(keyframe.lice, match_.world().lice());
  if (!found.empty())
    differ(keyframe.tick, "the keyframe is another, though every hash up to it is the same");
  if (!difference_) return;
  difference_->detail = joined(
      {"keyframe ", std::to_string(keyframe.tick), ": ",
       found.empty() ? "the same lice, so what was altered moved none: a hash, or an input without effect"
                     : found});
}

void Rerun::differ(std::uint64_t tick, std::string what) {
  if (!difference_) difference_ = Difference{tick, std::move(what), {}};
}

}  // namespace woodlouse::replay
