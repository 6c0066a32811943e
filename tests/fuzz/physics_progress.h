// What libFuzzer is shown of a game beside the branches taken, those of the physics not being compiled for
// it: which events it had on which kind of map, and how near it came to making energy. An input with
// something new in it is kept.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "shared/physics/step_counters.h"
#include "shared/state/parameters.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::fuzz {

/// libFuzzer looks at these bytes after each input, and clears them; a byte's power of two counts.
class Progress {
 public:
  void note_events(const terrain::Terrain& terrain, const state::Parameters& p,
                   const physics::StepCounters& counters) {
    const std::size_t rim = p.edges == state::Edges::kWrap                    ? 1
                            : p.contact == state::SurfaceContact::kUnilateral ? 2
                            : p.central_gravity > 0.0                         ? 3
                                                                              : 0;
    std::size_t kind = terrain.surface().index();
    kind = kind * kMethods + static_cast<std::size_t>(p.method);
    kind = kind * 4 + rim;
    kind = kind * 2 + (p.friction > 0.0 ? 1 : 0);
    const std::array events{counters.sub_steps, counters.capped,  counters.samples,
                            counters.bounces,   counters.flights, counters.stops};
    static_assert(events.size() == kEvents);
    for (std::size_t k = 0; k < kEvents; ++k) {
      events_[kind * kEvents + k] = static_cast<std::uint8_t>(std::min<std::uint64_t>(events[k], 255));
    }
  }

  /// share: of the energy that there was, what a tick gave beyond its push.
  void note_gain(state::Method method, double share) {
    if (!(share > 0.0)) return;
    const int level =
        std::clamp(std::ilogb(share) + static_cast<int>(kLevels), 0, static_cast<int>(kLevels) - 1);
    gains_[static_cast<std::size_t>(method) * kLevels + static_cast<std::size_t>(level)] = 1;
  }

 private:
  static constexpr std::size_t kGrounds = std::variant_size_v<terrain::Terrain::Alternatives>;
  static constexpr std::size_t kMethods = 4, kEvents = 6, kLevels = 40;
  std::array<std::uint8_t, kGrounds * kMethods * 8 * kEvents> events_{};
  std::array<std::uint8_t, kMethods * kLevels> gains_{};
};

[[gnu::section("__libfuzzer_extra_counters")]] inline Progress progress;

}  // namespace woodlouse::fuzz
