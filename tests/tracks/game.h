// A shipped map's mode, played by the house's bots alone.
#pragma once

#include <catch2/catch.hpp>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/bots/team.h"
#include "shared/map/map_file.h"
#include "shared/match/match.h"

namespace woodlouse::tests {

inline std::shared_ptr<const map::Map> shipped_map(const std::string& name) {
  auto map = map::load_map(std::filesystem::path(WOODLOUSE_SOURCE_DIR "/maps") / (name + ".json"));
  REQUIRE(map);
  return *map;
}

class BotGame {
 public:
  BotGame(const std::string& name, state::Mode mode, std::uint32_t bots, server::bots::Skill skill,
          std::uint64_t seed = 1)
      : map(shipped_map(name)),
        match(map, {60, seed, mode}),
        team(*map, match.settings(), skill, bots),
        seqs(bots, 1) {
    for (std::uint32_t number = 0; number < bots; ++number)
      team.take(match.join({"bot", state::Role::kBot}), number, seqs[number]);
  }

  /// Ends early where `watch` says so. False: it never did.
  bool play(double seconds, const std::function<bool(const match::StepRecord&)>& watch) {
    for (int tick = 0; tick < static_cast<int>(60.0 * seconds); ++tick) {
      team.steer(match);
      if (watch(match.advance())) return true;
    }
    return false;
  }

  std::shared_ptr<const map::Map> map;
  match::Match match;
  server::bots::Team team;
  std::vector<std::uint32_t> seqs;
};

}  // namespace woodlouse::tests
