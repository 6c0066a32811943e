#include "bench/lab/speed/modes.h"

#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "bench/lab/report/race.h"
#include "bench/lab/speed/maps.h"
#include "shared/core/random.h"
#include "shared/match/match.h"

namespace woodlouse::lab {
namespace {

constexpr std::uint32_t kTickHz = 60;
constexpr std::uint32_t kChangeTicks = 120;  // a held thrust points elsewhere after that many ticks
constexpr int kTicks = 10;                   // of a turn

/// Lice that are pushed about, by the rules of a mode.
class Game {
 public:
  Game(const std::shared_ptr<const map::Map>& map, state::Mode mode, std::uint32_t lice, int settled)
      : match_(map, {kTickHz, 1, mode}), lice_(lice), seqs_(lice + 1, 0) {
    for (std::uint32_t id = 1; id <= lice; ++id) match_.join({std::to_string(id), state::Role::kBot});
    for (int tick = 0; tick < settled; ++tick) step();
  }
  void run() {
    for (int tick = 0; tick < kTicks; ++tick) step();
    keep(match_.hash());
  }

 private:
  /// Some in each tick, everybody in kChangeTicks; all of them in the beginning.
  void step() {
    const std::uint32_t count = match_.tick() == 1 ? lice_ : (lice_ + due_++ % kChangeTicks) / kChangeTicks;
    for (std::uint32_t i = 0; i < count; ++i) {
      next_ = next_ % lice_ + 1;
      const double angle = 2.0 * std::numbers::pi * random_.uniform();
      const state::Thrust push = state::rounded_map_vector({std::cos(angle), std::sin(angle)}).thrust;
      match_.file({next_, ++seqs_[next_], push, state::kHeld, 0});
    }
    match_.advance();
  }

  match::Match match_;
  std::uint32_t lice_;
  std::vector<std::uint32_t> seqs_;
  core::Random random_{2};
  std::uint32_t next_ = 0, due_ = 0;
};

}  // namespace

core::Expected<void> measure_modes(const std::filesystem::path& folder, const Output& output) {
  const auto maps = maps_of(folder);
  if (!maps) return tl::unexpected(maps.error());
  const std::vector<std::uint32_t> crowds =
      output.quick ? std::vector<std::uint32_t>{200} : std::vector<std::uint32_t>{20, 200, 1000};
  Table table({"map", "mode", "lice", "us_roam", "us_mode", "share"});
  for (const auto& map : *maps) {
    for (const state::Mode mode : state::kModes) {
      if (mode == state::Mode::kRoam || !map->definition.modes.has(mode)) continue;
      for (const std::uint32_t lice : crowds) {
        constexpr int kSettled = 600;
        Game roam(map, state::Mode::kRoam, lice, kSettled), played(map, mode, lice, kSettled);
        const std::string what = map->definition.name + "/" + std::string(state::to_text(mode));
        const auto times = race({{"", [&] { roam.run(); }, kTicks}, {"", [&] { played.run(); }, kTicks}},
                                output.effort(), what);
        const double without = 1e-3 * times[0].median_ns, with = 1e-3 * times[1].median_ns;
        table.add({map->definition.name, std::string(state::to_text(mode)), static_cast<double>(lice),
                   without, with, (with - without) / with});
      }
    }
  }
  std::cout << "\nA tick of a match with its hash, without rules and by them [us]; share: of the rules\n";
  table.print(std::cout);
  return output.write(table, "lab-speed-modes");
}

}  // namespace woodlouse::lab
