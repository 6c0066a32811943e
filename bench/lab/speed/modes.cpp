#include "bench/lab/speed/modes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "bench/lab/report/race.h"
#include "bench/lab/speed/maps.h"
#include "shared/core/random.h"
#include "shared/map/map_world.h"
#include "shared/rules/rules.h"
#include "shared/state/state_hash.h"

namespace woodlouse::lab {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kTickHz = 60;
constexpr std::uint32_t kChangeTicks = 120;  // a held thrust points elsewhere after that many ticks

/// A match's tick in its parts, with lice that are pushed about. It is by the rules' doing where they are: so
/// the rules are timed within it, not against another game.
class Game {
 public:
  Game(const std::shared_ptr<const map::Map>& map, state::Mode mode, std::uint32_t lice)
      : map_(map),
        world_(map::make_world(*map, 1.0 / kTickHz, mode)),
        rules_(rules::Rules::make(mode, *map, kTickHz)),
        lice_(lice) {
    const auto spawns = rules_->spawns();
    for (std::uint32_t id = 1; id <= lice; ++id) {
      const map::SpawnPoint& spawn = spawns[id % spawns.size()];
      state::Louse louse;
      louse.id = id;
      louse.position = spawn.position;
      louse.heading = spawn.heading;
      world_.insert(louse);
      rules_->join(id);
    }
    for (std::uint32_t id = 1; id <= lice; ++id) push(id);
  }

  /// The whole tick and what the rules took of it [us].
  std::pair<double, double> tick() {
    const std::uint32_t count = (lice_ + due_++ % kChangeTicks) / kChangeTicks;
    for (std::uint32_t i = 0; i < count; ++i) push(next_ = next_ % lice_ + 1);
    const auto begin = Clock::now();
    rules_->before_step(world_);
    const auto before = Clock::now();
    world_.step();
    const auto stepped = Clock::now();
    rules_->after_step(world_, tick_++, hash_);
    const auto judged = Clock::now();
    blocks_.update(world_.lice(), world_.changed_blocks());
    world_.forget_changes();
    hash_ = state::state_hash(hasher_, {hash_, 0, 0, rules_->hash(), tick_, 0}, blocks_.values());
    const auto end = Clock::now();
    const auto us = [](Clock::duration time) {
      return std::chrono::duration<double, std::micro>(time).count();
    };
    return {us(end - begin), us(before - begin) + us(judged - stepped)};
  }

 private:
  void push(std::uint32_t id) {
    const double angle = 2.0 * std::numbers::pi * random_.uniform();
    world_.set_thrust(id, state::rounded_map_vector({std::cos(angle), std::sin(angle)}).thrust, state::kHeld);
  }

  std::shared_ptr<const map::Map> map_;
  physics::World world_;
  std::unique_ptr<rules::Rules> rules_;
  std::uint32_t lice_;
  core::Random random_{2};
  std::uint32_t next_ = 0, due_ = 0;
  std::uint64_t tick_ = 0, hash_ = 0;
  state::BlockHashes blocks_;
  core::StableHasher hasher_;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

core::Expected<void> measure_modes(const std::filesystem::path& folder, const Output& output) {
  const auto maps = maps_of(folder);
  if (!maps) return tl::unexpected(maps.error());
  const std::vector<std::uint32_t> crowds =
      output.quick ? std::vector<std::uint32_t>{200} : std::vector<std::uint32_t>{20, 200, 1000};
  const int settled = 1200, measured = output.quick ? 600 : 6000;  // ticks
  Table table({"map", "mode", "lice", "us_tick", "us_rules", "share"});
  for (const auto& map : *maps) {
    for (const state::Mode mode : state::kModes) {
      if (mode == state::Mode::kRoam || !map->definition.modes.has(mode)) continue;
      for (const std::uint32_t lice : crowds) {
        Game game(map, mode, lice);
        std::vector<double> whole, of_rules;
        for (int tick = 0; tick < settled; ++tick) game.tick();
        for (int tick = 0; tick < measured; ++tick) {
          const auto [all, rules] = game.tick();
          whole.push_back(all);
          of_rules.push_back(rules);
        }
        const double tick = median(whole), rules = median(of_rules);
        table.add({map->definition.name, std::string(state::to_text(mode)), static_cast<double>(lice), tick,
                   rules, rules / tick});
      }
    }
  }
  std::cout << "\nA tick of a game with its hash and the rules' part of it [us], medians\n";
  table.print(std::cout);
  return output.write(table, "lab-speed-modes");
}

}  // namespace woodlouse::lab
