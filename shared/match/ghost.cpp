#include "shared/match/ghost.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <optional>
#include <span>

#include "shared/core/joined.h"
#include "shared/map/map_world.h"
#include "shared/map/spawns.h"
#include "shared/rules/race.h"
#include "shared/state/mode.h"

namespace woodlouse::match {
namespace {

using rules::Moment;

constexpr state::LouseId kAlone = 1;
constexpr std::uint64_t kWithoutEnd = UINT64_MAX / 2;  // [ticks]

std::size_t gates_of_run(const map::RaceMode& race) { return race.gates.size() * race.laps + 1; }

/// "gate 2 of lap 1": the index-th that a run leads through. Laps are counted from 1, as people do.
std::string gate_name(const map::RaceMode& race, std::size_t index) {
  const std::size_t gates = race.gates.size();
  if (index == 0) return "gate 0, where the clock starts";
  return core::joined(
      {"gate ", std::to_string(index % gates), ", in lap ", std::to_string((index - 1) / gates + 1)});
}

/// "tick 812.25": of whoever was spawned at tick 0.
std::string tick_text(Moment moment) {
  const std::string hundredths =
      std::to_string(moment % rules::kMomentsPerTick * 100 / rules::kMomentsPerTick);
  return core::joined({"tick ", std::to_string(moment / rules::kMomentsPerTick), ".",
                       hundredths.size() == 1 ? "0" : "", hundredths});
}

bool applies(const state::GhostInput& input) {
  const core::Vec2 value = input.thrust.value;
  if (!(core::dot(value, value) <= 1.0) || input.ticks == 0) return false;
  switch (input.thrust.kind) {
    case state::ThrustKind::kNone:
      return value == core::Vec2{};
    case state::ThrustKind::kAlongHeading:
      return state::rounded_along_heading(value.x).thrust.value == value;
    case state::ThrustKind::kMapVector:
      return state::rounded_map_vector(value).thrust.value == value;
  }
  return false;
}

}  // namespace

std::string why_no_ghost(const map::Map& map, std::uint32_t tick_hz, const state::Ghost& ghost) {
  const map::RaceMode& race = *map.definition.modes.race;
  const std::size_t spawns = race.spawns.empty() ? map.definition.spawns.size() : race.spawns.size();
  if (ghost.spawn >= spawns)
    return core::joined({"it begins at spawn ", std::to_string(ghost.spawn), ", but the race has only ",
                         std::to_string(spawns), ", from 0"});
  if (ghost.ticks > std::uint64_t{state::kMostGhostSeconds} * tick_hz)
    return core::joined({"it takes more than ", std::to_string(state::kMostGhostSeconds), " s"});
  if (ghost.inputs.size() > state::kMostGhostInputs)
    return core::joined({"it has more than ", std::to_string(state::kMostGhostInputs), " inputs"});
  std::uint32_t last = 0;
  for (std::size_t k = 0; k < ghost.inputs.size(); ++k) {
    const state::GhostInput& input = ghost.inputs[k];
    if (input.at < last || input.at >= ghost.ticks || !applies(input))
      return core::joined({"its input ", std::to_string(k), " is none that a step of it could have taken"});
    last = input.at;
  }
  return {};
}

Rerun rerun(const map::Map& map, std::uint32_t tick_hz, const state::Ghost& ghost) {
  assert(why_no_ghost(map, tick_hz, ghost).empty());
  physics::World world = map::make_world(map, 1.0 / static_cast<double>(tick_hz), state::Mode::kRace);
  rules::Race race(map, tick_hz, kWithoutEnd);
  const auto step = [&](std::uint64_t tick) {
    race.before_step(world);
    world.step();
    race.after_step(world, tick, 0);
  };
  race.join(kAlone);
  step(0);  // in which the round begins: from the next one on gates count
  world.insert(map::louse_at(race.spawns()[ghost.spawn], kAlone));
  Rerun driven;
  auto input = ghost.inputs.begin();
  while (driven.ticks < ghost.ticks && !driven.is_whole) {
    for (; input != ghost.inputs.end() && input->at == driven.ticks; ++input)
      world.set_thrust(kAlone, input->thrust, input->ticks);
    step(++driven.ticks);
    for (const rules::Event& event : race.events()) {
      if (event.kind == rules::EventKind::kGate)
        driven.times.gates.push_back(event.moment - rules::kMomentsPerTick);
      if (event.kind != rules::EventKind::kRun) continue;
      driven.is_whole = true;  // the gates behind it, in the same step, are the next run's
      break;
    }
  }
  return driven;
}

std::string departure(const map::Map& map, const RunTimes& said, const state::Ghost& ghost,
                      const Rerun& driven) {
  const map::RaceMode& race = *map.definition.modes.race;
  if (said.gates.size() != gates_of_run(race))
    return core::joined({"it tells of ", std::to_string(said.gates.size()),
                         " gates, but a run leads through ", std::to_string(gates_of_run(race))});
  const std::vector<Moment>& gates = driven.times.gates;
  for (std::size_t k = 0; k < said.gates.size(); ++k) {
    if (k < gates.size() && gates[k] == said.gates[k]) continue;
    return core::joined(
        {gate_name(race, k), ", is said to be driven through at ", tick_text(said.gates[k]), ", but re-run ",
         k < gates.size() ? core::joined({"that is at ", tick_text(gates[k])})
                          : core::joined({"it is not, until tick ", std::to_string(driven.ticks)})});
  }
  if (driven.ticks != ghost.ticks)
    return core::joined({"it is done after tick ", std::to_string(driven.ticks), ", said to be after tick ",
                         std::to_string(ghost.ticks)});
  return {};
}

std::string why_not_proven(const map::Map& map, std::uint32_t tick_hz, const state::Ghost& ghost,
                           const RunTimes& said) {
  std::string why = why_no_ghost(map, tick_hz, ghost);
  if (!why.empty()) return why;
  return departure(map, said, ghost, rerun(map, tick_hz, ghost));
}

}  // namespace woodlouse::match
