#include "bench/lab/game/error_hour.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <iostream>
#include <numeric>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "bench/lab/report/progress.h"
#include "bench/lab/report/side_by_side.h"
#include "bench/lab/speed/maps.h"
#include "shared/map/map_world.h"
#include "shared/match/step_error.h"
#include "shared/match/twin.h"

namespace woodlouse::lab {
namespace {

constexpr int kRate = 60;
constexpr std::uint64_t kMinute = 60 * kRate;  // [ticks]
constexpr std::array<std::string_view, 4> kMaps = {"volcano", "hills", "torus", "jumps"};

/// Tells each louse what its own play says at that tick, where it changes.
void steer_each(physics::World& world, std::uint64_t tick) {
  constexpr std::uint64_t kPart = 2 * kRate / 5;  // 0.4 s
  const std::vector<state::Louse> lice(world.lice().begin(), world.lice().end());
  for (std::size_t i = 0; i < lice.size(); ++i) {
    const std::uint64_t each = is_of_ticks(kPlays[i]) ? 1 : kPart;
    if (tick % each == 0)
      world.set_thrust(lice[i].id, thrust_in(kPlays[i], lice[i].id, tick / each), state::kHeld);
  }
}

/// Of the twin's windows that ended since `seen` of each louse did.
void add_windows(const match::Twin& twin, std::size_t seen, ErrorMinute& minute) {
  std::vector<std::pair<double, Play>> apart;
  std::size_t louse = 0;
  for (const auto& [id, windows] : twin.divergences()) {
    for (std::size_t k = seen; k < windows.size(); ++k) apart.emplace_back(windows[k], kPlays[louse]);
    ++louse;
  }
  std::sort(apart.begin(), apart.end());
  assert(!apart.empty() && louse == kPlays.size());
  minute.windows = apart.size();
  minute.apart_median = apart[(apart.size() - 1) / 2].first;
  minute.apart_most = apart.back().first;
  minute.straying = apart.back().second;
}

/// A panel for each of the maps; minutes of each in $m0, $m1 ...
std::string picture(const std::vector<std::vector<ErrorMinute>>& maps) {
  std::ostringstream script;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    script << "$m" << i << " << EOD\n";
    for (std::size_t k = 0; k < maps[i].size(); ++k)
      script << static_cast<double>(k) + 0.5 << ' ' << maps[i][k].of_play << ' ' << maps[i][k].apart_median
             << ' ' << maps[i][k].apart_most << '\n';
    script << "EOD\n";
  }
  script << "set multiplot layout 2,2\nset logscale y\nset format y '10^{%L}'\nset yrange [1e-9:100]\n"
         << "set grid y lc rgb '#dddddd'\nset key bottom right opaque\nset xlabel 'minute of play'\n"
         << "set xrange [0:" << maps.front().size() << "]\n";
  for (std::size_t i = 0; i < maps.size(); ++i)
    script << "set title '" << kMaps[i] << "'\nplot $m" << i
           << " using 1:4 with points pt 6 ps 0.7 lc rgb '#D55E00' title 'twin after 10 s, the most [m]', $m"
           << i << " using 1:3 with lines lw 1.5 lc rgb '#E69F00' title 'twin after 10 s, median [m]', $m"
           << i << " using 1:2 with lines lw 2 lc rgb '#0072B2' title 'error [m/s of play]'\n";
  script << "unset multiplot\n";
  return script.str();
}

}  // namespace

std::vector<ErrorMinute> error_minutes(const map::Map& map, std::size_t minutes) {
  physics::World world = map::make_world(map, 1.0 / kRate);
  world.restore(starting_lice(map, kPlays.size(), 5));
  match::StepError error(map, 1.0 / kRate, state::Mode::kRoam);
  match::Twin twin(map, 1.0 / kRate, state::Mode::kRoam);
  constexpr std::size_t kWindows = kMinute / static_cast<std::size_t>(match::Twin::kSeconds * kRate);
  std::vector<ErrorMinute> result;
  for (std::size_t k = 0; k < minutes; ++k) {
    ErrorMinute minute;
    std::array<double, kPlays.size()> sums{};
    for (std::uint64_t tick = k * kMinute; tick < (k + 1) * kMinute; ++tick) {
      steer_each(world, tick);
      error.observe(world.lice(), tick);
      for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i] += error.bounds()[i];
        minute.worst = std::max(minute.worst, error.bounds()[i]);
      }
      twin.observe(world.lice(), error.stepped());
      world.step();
    }
    const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
    const auto most = std::max_element(sums.begin(), sums.end());
    minute.of_play = sum / (60.0 * static_cast<double>(sums.size()));
    minute.share = sum > 0.0 ? *most / sum : 0.0;
    minute.erring = kPlays[static_cast<std::size_t>(most - sums.begin())];
    add_windows(twin, k * kWindows, minute);
    result.push_back(minute);
  }
  assert(result.size() == minutes);
  return result;
}

core::Expected<void> measure_error_hour(const Output& output) {
  const auto all = maps_of({});
  if (!all) return tl::unexpected(all.error());
  const std::size_t minutes = output.effort() == Effort::kQuick ? 2 : 60;
  Table table({"map", "minute", "error_m_per_s", "share_of_one", "steered_by", "worst_m", "windows",
               "apart_median_m", "apart_most_m", "its_steered_by"});
  std::vector<const map::Map*> measured;
  for (const std::string_view name : kMaps) {
    const auto map =
        std::find_if(all->begin(), all->end(), [&](const auto& m) { return m->definition.name == name; });
    if (map == all->end()) return core::fail("maps", "there is no " + std::string(name));
    measured.push_back(map->get());
  }
  std::vector<std::vector<ErrorMinute>> drawn(measured.size());
  Progress progress("an hour's errors", measured.size());
  side_by_side(
      measured.size(), [&](std::size_t i) { drawn[i] = error_minutes(*measured[i], minutes); },
      [&] { progress.advance(); });
  for (std::size_t i = 0; i < measured.size(); ++i) {
    for (std::size_t k = 0; k < minutes; ++k) {
      const ErrorMinute& minute = drawn[i][k];
      table.add({std::string(kMaps[i]), static_cast<double>(k + 1), minute.of_play, minute.share,
                 std::string(to_text(minute.erring)), minute.worst, static_cast<double>(minute.windows),
                 minute.apart_median, minute.apart_most, std::string(to_text(minute.straying))});
    }
  }
  table.print(std::cout);
  if (auto done = output.write(table, "lab-error-hour"); !done) return done;
  return output.draw(picture(drawn), "lab-error-hour", 1200, 860);
}

}  // namespace woodlouse::lab
