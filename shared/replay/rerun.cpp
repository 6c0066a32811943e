#include "shared/replay/rerun.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "shared/core/joined.h"
#include "shared/json/text.h"
#include "shared/state/louse_fields.h"

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
  constexpr std::string_view kNames[] = {"", "join of ", "leave of ", "respawn of ", "respawn at a gate of "};
  return joined({kNames[static_cast<std::size_t>(change.action)], "player ", std::to_string(change.player)});
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

std::string too_many_lice() {
  return joined({"more than ", std::to_string(kMaxLice), " lice: no server plays so many"});
}

std::string field_text(const state::LouseField& field, double value) {
  return state::holds_integer(field) ? std::to_string(static_cast<std::uint32_t>(value))
                                     : json::double_text(value);
}

bool is_before(const match::AppliedInput& a, const match::AppliedInput& b) {
  return std::tuple(a.tick, a.player, a.seq) < std::tuple(b.tick, b.player, b.seq);
}

/// What waits in the re-run waits in the recording; more may wait there, that came since the last keyframe.
std::string unlike_waiting(const std::vector<match::AppliedInput>& recorded,
                           const std::vector<match::AppliedInput>& rerun) {
  for (const match::AppliedInput& input : rerun) {
    const auto found = std::lower_bound(recorded.begin(), recorded.end(), input, is_before);
    if (found != recorded.end() && *found == input) continue;
    return joined({"waiting: the input of ", name_of(input), " is missing or another"});
  }
  return {};
}

/// A player's last seq is the highest that was applied or waits.
std::string unlike_players(const match::MatchState& recorded, std::vector<match::PlayerSeq> rerun) {
  for (const match::AppliedInput& input : recorded.waiting) {
    for (match::PlayerSeq& player : rerun) {
      if (player.player == input.player)
        player.last_seq = std::max(player.last_seq, std::optional(input.seq));
    }
  }
  if (recorded.players == rerun) return {};
  const std::size_t count = std::min(recorded.players.size(), rerun.size());
  for (std::size_t k = 0; k < count; ++k) {
    const match::PlayerSeq& a = recorded.players[k];
    const match::PlayerSeq& b = rerun[k];
    const auto seq = [](const match::PlayerSeq& p) {
      return p.last_seq ? std::to_string(*p.last_seq) : "none";
    };
    if (a == b) continue;
    if (a.player == b.player) {
      return joined({"player ", std::to_string(a.player), ", seq: ", both(seq(a), seq(b))});
    }
    return joined({"players: ", both(std::to_string(a.player), std::to_string(b.player))});
  }
  return joined({"players: ", both(std::to_string(recorded.players.size()), std::to_string(rerun.size()))});
}

/// Of who is in both; who is not, unlike_players() tells.
std::string unlike_labels(const match::PlayerLabels& recorded, const match::PlayerLabels& rerun) {
  for (const auto& [player, label] : recorded) {
    const auto own = rerun.find(player);
    if (own != rerun.end() && own->second != label)
      return joined({"the name or role of player ", std::to_string(player), " is another"});
  }
  return {};
}

}  // namespace

std::string first_difference(std::span<const state::Louse> recorded, std::span<const state::Louse> rerun) {
  std::size_t k = 0;
  for (; k < recorded.size() && k < rerun.size() && recorded[k].id == rerun[k].id; ++k) {
    for (const state::LouseField& field : state::kLouseFields) {
      const double a = state::field_value(recorded[k], field), b = state::field_value(rerun[k], field);
      if (std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b)) continue;
      return joined({"louse ", std::to_string(recorded[k].id), ", ", field.name, ": ",
                     both(field_text(field, a), field_text(field, b))});
    }
  }
  if (k == recorded.size() && k == rerun.size()) return {};
  const bool only_recorded = k == rerun.size() || (k < recorded.size() && recorded[k].id < rerun[k].id);
  const state::LouseId id = only_recorded ? recorded[k].id : rerun[k].id;
  return joined(
      {"louse ", std::to_string(id), only_recorded ? " is only in the recording" : " is only in the re-run"});
}

core::Expected<std::unique_ptr<Rerun>> Rerun::from(std::shared_ptr<const map::Map> map,
                                                   const match::MatchSettings& settings, Keyframe keyframe,
                                                   const std::string& place) {
  const match::MatchState& state = keyframe.state;
  if (state.lice.size() > kMaxLice) return core::fail(place, too_many_lice());
  const std::string fault = match::why_not(*map, settings, state);
  if (!fault.empty()) {
    return core::fail(place, joined({"keyframe ", std::to_string(state.tick), ": ", fault}),
                      "it was altered");
  }
  const match::PlayerId last_joined = state.next_player - 1;
  return std::unique_ptr<Rerun>(
      new Rerun(match::Match::restore(std::move(map), settings, state), last_joined));
}

core::Expected<std::unique_ptr<Rerun>> Rerun::from_recorded(std::shared_ptr<const map::Map> map,
                                                            const match::MatchSettings& settings,
                                                            Keyframe keyframe, const std::string& place) {
  std::string unlike;
  if (keyframe.state.tick == 0) {
    const Rerun fresh(std::make_unique<match::Match>(map, settings), 0);
    unlike = fresh.difference_to(keyframe);
    const std::size_t waiting = keyframe.state.waiting.size();
    if (waiting != 0) unlike = joined({"waiting: ", both(std::to_string(waiting), "0")});
  }
  auto rerun = from(std::move(map), settings, std::move(keyframe), place);
  if (rerun && !unlike.empty())
    return core::fail(place, joined({"keyframe 0: ", unlike}), "no game begins so: it was altered");
  return rerun;
}

core::Expected<std::optional<Difference>> Rerun::step(const StepLine& line, const std::string& place) {
  const match::StepRecord& recorded = line.step;
  if (recorded.tick != match_->tick()) {
    return core::fail(place,
                      joined({"step ", std::to_string(recorded.tick), " stands where step ",
                              std::to_string(match_->tick()), " is due"}),
                      "lines are missing or out of order");
  }
  std::size_t lice = match_->world().lice().size();
  for (const match::RosterChange& change : recorded.roster) {
    switch (change.action) {
      case match::RosterAction::kJoin:
        if (++lice > kMaxLice) return core::fail(place, too_many_lice());
        if (change.player <= last_joined_) {
          return core::fail(place,
                            joined({"player ", std::to_string(change.player), " joins after player ",
                                    std::to_string(last_joined_)}),
                            "ids ascend and are never used again");
        }
        last_joined_ = change.player;
        match_->join_as(change.player, change.label);
        break;
      case match::RosterAction::kLeave:
        if (lice > 0) --lice;
        match_->leave(change.player);
        break;
      case match::RosterAction::kRespawn:
        match_->respawn(change.player);
        break;
      case match::RosterAction::kRespawnAtGate:
        match_->respawn_at_gate(change.player);
        break;
    }
  }
  std::optional<Difference> difference;
  const auto differ = [&](std::uint64_t tick, std::string what) {
    if (!difference) difference = Difference{tick, std::move(what), {}};
  };
  for (const match::AppliedInput& input : recorded.inputs) {
    if (match_->file_applied(input)) continue;
    differ(recorded.tick,
           joined({"the input of ", name_of(input), " can't be applied: the player has no louse"}));
  }
  const match::StepRecord& rerun = match_->advance();
  last_ = &rerun;
  const std::string step = joined({" of step ", std::to_string(recorded.tick), ": "});
  if (recorded.roster != rerun.roster) {
    differ(recorded.tick, joined({"roster", step, first_unlike(recorded.roster, rerun.roster)}));
  }
  if (recorded.inputs != rerun.inputs) {
    differ(recorded.tick, joined({"inputs", step, first_unlike(recorded.inputs, rerun.inputs)}));
  }
  if (recorded.hash != rerun.hash) {
    differ(recorded.tick + 1, joined({"hash ", both(core::to_hex(recorded.hash), core::to_hex(rerun.hash))}));
  }
  return difference;
}

std::uint64_t Rerun::stand_still(std::uint64_t most) {
  if (!match_->stands_still()) return 0;
  match_->stand_still(most);
  return most;
}

std::string Rerun::difference_to(const Keyframe& keyframe) const {
  const match::MatchState& recorded = keyframe.state;
  const match::MatchState own = match_->state();
  assert(recorded.tick == own.tick);
  std::string found = first_difference(recorded.lice, own.lice);
  // Before the hashes, which another name changes, too.
  if (found.empty()) found = unlike_labels(recorded.labels, own.labels);
  const auto compare = [&](std::string_view name, std::uint64_t a, std::uint64_t b) {
    if (found.empty() && a != b) found = joined({name, ": ", both(core::to_hex(a), core::to_hex(b))});
  };
  compare("generator", recorded.link.generator, own.link.generator);
  compare("hash", recorded.hash, own.hash);
  compare("previous", recorded.link.previous, own.link.previous);
  compare("inputs", recorded.link.inputs, own.link.inputs);
  compare("roster", recorded.link.roster, own.link.roster);
  compare("rules", recorded.link.rules, own.link.rules);
  compare("link", recorded.link.tick, own.link.tick);
  if (found.empty() && recorded.next_player != own.next_player) {
    found = joined(
        {"next_player: ", both(std::to_string(recorded.next_player), std::to_string(own.next_player))});
  }
  if (found.empty()) found = unlike_waiting(recorded.waiting, own.waiting);
  if (found.empty()) found = unlike_players(recorded, own.players);
  return found;
}

}  // namespace woodlouse::replay
