#include "bench/scenario/scenario.h"

#include <span>

#include "shared/core/stable_hash.h"

namespace woodlouse::scenario {

std::uint64_t script_digest(const Scenario& scenario) {
  core::StableHasher hasher;
  hasher.append(scenario.map->hash);
  hasher.append(scenario.settings.tick_hz);
  hasher.append(scenario.settings.seed);
  if (scenario.settings.mode != state::Mode::kRoam) hasher.append(scenario.settings.mode);
  for (const Event& event : scenario.events) {
    hasher.append(event.step);
    hasher.append(event.kind);
    hasher.append(event.player);
    hasher.append(event.thrust.kind);
    hasher.append(event.thrust.value);
    hasher.append(event.ticks);
  }
  for (const GoldenHash& golden : scenario.goldens) hasher.append(golden.tick);
  return hasher.value();
}

std::uint64_t golden_digest(const std::vector<std::uint64_t>& hashes) {
  core::StableHasher hasher;
  hasher.append(std::span<const std::uint64_t>(hashes));
  return hasher.value();
}

}  // namespace woodlouse::scenario
