// A deterministic test without C++: a map, who comes and goes, timed inputs, and the state hashes that must
// come out. Read from tests/scenarios/*.json (docs/determinism.md tells the format), played by play.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shared/map/map_definition.h"
#include "shared/match/match.h"

namespace woodlouse::scenario {

/// What happens just before a step is performed.
struct Event {
  enum class Kind : std::uint32_t { kJoin, kLeave, kRespawn, kInput };
  std::uint64_t step = 0;
  Kind kind = Kind::kInput;
  match::PlayerId player = 0;
  state::Thrust thrust;                ///< of kInput
  std::uint32_t ticks = state::kHeld;  ///< of kInput: how long it acts
};

struct GoldenHash {
  std::uint64_t tick = 0;             ///< >= 1
  std::optional<std::uint64_t> hash;  ///< nothing: not known yet, `null` in the file
};

/// A piece of a file's text.
struct Span {
  std::size_t begin = 0;
  std::size_t size = 0;
};

struct Scenario {
  std::string name;  ///< the file's, without folder and .json
  std::filesystem::path file;
  int behavior = 0;  ///< match::kBehavior that the hashes were made with
  std::shared_ptr<const map::Map> map;
  match::MatchSettings settings;
  std::vector<Event> events;        ///< by step, and within a step in the order of the file
  std::vector<GoldenHash> goldens;  ///< by tick, at least one; the last one ends the match
  /// What the rules of play must say (rules/event.h, to_text); nothing: it is not asked for.
  std::optional<std::vector<std::string>> rulings;

  std::string text;     ///< the file's
  Span behavior_place;  ///< the values in text that --update replaces
  Span goldens_place;
  Span rulings_place;
  std::size_t goldens_line = 0;  ///< from 1

  [[nodiscard]] std::uint64_t last_tick() const { return goldens.back().tick; }
};

/// Identifies what is played, whatever the file says comes out: map, tick rate, seed, events, hashed ticks.
std::uint64_t script_digest(const Scenario& scenario);

/// Of hashes at the scenario's ticks, in their order.
std::uint64_t golden_digest(const std::vector<std::uint64_t>& hashes);

}  // namespace woodlouse::scenario
