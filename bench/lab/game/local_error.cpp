#include "bench/lab/game/local_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "bench/lab/report/progress.h"
#include "bench/lab/report/side_by_side.h"
#include "bench/lab/speed/maps.h"
#include "shared/map/map_world.h"
#include "shared/match/step_error.h"

namespace woodlouse::lab {
namespace {

constexpr std::array kRates = {15, 60, 240, 1000};
/// A step of the maps that the reference is not for errs in proportion to its length: so many parts leave
/// less than a thousandth of the tick's error.
constexpr std::uint32_t kFineParts = 16 * match::StepError::kParts;

double at(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// A tick's end by the reference, as a louse of doubles plus what they leave out.
class Truth {
 public:
  Truth(const map::Map& map, double tick)
      : map_(map),
        physics_(map::physics_of(map.definition, state::Mode::kRoam)),
        tick_(tick),
        is_measured_(is_measured(map)),
        fine_(map, tick, state::Mode::kRoam, kFineParts) {}

  /// How far `end` is from where the tick should have led `start`; nothing: the reference does not know.
  std::optional<double> error(const state::Louse& start, const state::Louse& end) {
    if (!is_measured_) {
      const state::Louse& fine = fine_.run({&start, 1})[0];
      return match::distance_apart(end, fine, map_.terrain->domain(), physics_.edges);
    }
    reference::Motion motion(*map_.terrain, physics_, start);
    motion.advance(tick_, {start.thrust_kind, start.thrust});
    if (motion.gave_up()) return std::nullopt;
    const auto v = motion.velocity();
    return error_of(map_, end, motion) +
           match::kAhead * static_cast<double>(std::hypot(end.velocity.x - v.x, end.velocity.y - v.y));
  }

 private:
  const map::Map& map_;
  state::Parameters physics_;
  double tick_;
  bool is_measured_;
  match::PartedTick fine_;
};

/// Both panels' rows of one rate: place on the axis, share too small, ratio at 1, 50 and 99 of 100.
struct Drawn {
  std::string name;
  std::ostringstream rows;
};

std::string picture(const std::vector<std::string>& maps, const std::vector<Drawn>& rates) {
  constexpr std::array kColours = {"#0072B2", "#E69F00", "#009E73", "#CC79A7"};
  std::ostringstream script;
  for (std::size_t i = 0; i < rates.size(); ++i)
    script << "$r" << i << " << EOD\n" << rates[i].rows.str() << "EOD\n";
  script << "set xtics noenhanced rotate by -35 font ',9' (";
  for (std::size_t i = 0; i < maps.size(); ++i) script << (i == 0 ? "" : ", ") << "'" << maps[i] << "' " << i;
  script << ")\nset xrange [-0.6:" << static_cast<double>(maps.size()) - 0.4
         << "]\nset grid y lc rgb '#dddddd'\nset key outside top horizontal\nset multiplot layout 2,1\n"
         << "set title 'Ticks whose bound is below the true local error [%]; at most 1'\n"
         << "set yrange [0:1.2]\nplot 1 lc rgb 'black' dt 2 notitle";
  for (std::size_t i = 0; i < rates.size(); ++i)
    script << ", $r" << i << " using 1:(100*$2) with points pt " << 4 + i << " lc rgb '" << kColours[i]
           << "' title '" << rates[i].name << "'";
  script << "\nset title 'Bound / true local error: the median of all ticks, from 1 to 99 of 100; the median "
            "at most 100'\nset logscale y\nset format y '10^{%L}'\nset yrange [0.1:1e5]\n"
         << "plot 1 lc rgb 'black' dt 2 notitle, 100 lc rgb 'black' dt 2 notitle";
  for (std::size_t i = 0; i < rates.size(); ++i)
    script << ", $r" << i << " using 1:3:4:5 with yerrorbars pt " << 4 + i << " lc rgb '" << kColours[i]
           << "' notitle";
  script << "\nunset multiplot\n";
  return script.str();
}

}  // namespace

void LocalErrors::add(const LocalErrors& others) {
  unforeseen += others.unforeseen;
  bounds.insert(bounds.end(), others.bounds.begin(), others.bounds.end());
  truths.insert(truths.end(), others.truths.begin(), others.truths.end());
}

double LocalErrors::too_small() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < bounds.size(); ++i) count += bounds[i] < truths[i] ? 1 : 0;
  return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(1, bounds.size()));
}

double LocalErrors::ratio_at(double share) const {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (truths[i] > 0.0) ratios.push_back(bounds[i] / truths[i]);
  }
  return at(std::move(ratios), share);
}

LocalErrors local_errors(const map::Map& map, const std::vector<state::Louse>& lice, Play play, int rate,
                         std::size_t ticks, std::size_t stride) {
  const double tick_seconds = 1.0 / rate;
  physics::World world = map::make_world(map, tick_seconds);
  world.restore(lice);
  match::StepError error(map, tick_seconds, state::Mode::kRoam);
  Truth truth(map, tick_seconds);
  LocalErrors result;
  for (std::uint64_t tick = 0; tick < ticks * stride; ++tick) {
    steer(world, play, rate, tick);
    if (tick % stride == 0) {
      const std::vector<state::Louse> start(world.lice().begin(), world.lice().end());
      error.observe(start, tick);
      for (std::size_t i = 0; i < start.size(); ++i) {
        const bool rests = start[i].phase == state::Phase::kResting;
        if (rests && error.stepped()[i].phase == state::Phase::kResting) continue;
        const auto is = truth.error(start[i], error.stepped()[i]);
        if (!is) {
          ++result.unforeseen;
          continue;
        }
        result.bounds.push_back(error.bounds()[i]);
        result.truths.push_back(*is);
      }
    }
    world.step();
  }
  return result;
}

core::Expected<void> measure_local_error(const std::filesystem::path& folder, const Output& output) {
  const auto maps = maps_of(folder);
  if (!maps) return tl::unexpected(maps.error());
  const bool quick = output.effort() == Effort::kQuick;
  const std::size_t count = quick ? 4 : 12, ticks = quick ? 12 : 240;
  constexpr double kSeconds = 4.0;
  Table table({"map", "rate", "ticks", "unforeseen", "too_small", "ratio_1_of_100", "ratio_median",
               "ratio_99_of_100", "bound_median", "truth_median", "truth_worst"});
  std::vector<Drawn> drawn(kRates.size());
  std::vector<std::string> names;
  Progress progress("local errors", maps->size() * kRates.size());
  std::vector<LocalErrors> errors(maps->size() * kRates.size());
  side_by_side(
      errors.size(),
      [&](std::size_t i) {
        const map::Map& map = *(*maps)[i / kRates.size()];
        const int rate = kRates[i % kRates.size()];
        const auto stride =
            static_cast<std::size_t>(std::max(1.0, std::round(kSeconds * rate / static_cast<double>(ticks))));
        const std::vector<state::Louse> lice = starting_lice(map, count, 5);
        for (const Play play : kPlays) errors[i].add(local_errors(map, lice, play, rate, ticks, stride));
      },
      [&] { progress.advance(); });
  for (const auto& map : *maps) {
    for (std::size_t r = 0; r < kRates.size(); ++r) {
      const LocalErrors& all = errors[names.size() * kRates.size() + r];
      const double low = all.ratio_at(0.01), median = all.ratio_at(0.5), high = all.ratio_at(0.99);
      table.add({map->definition.name, static_cast<double>(kRates[r]), static_cast<double>(all.bounds.size()),
                 static_cast<double>(all.unforeseen), all.too_small(), low, median, high, at(all.bounds, 0.5),
                 at(all.truths, 0.5), at(all.truths, 1.0)});
      drawn[r].name = std::to_string(kRates[r]) + " Hz";
      const double place = static_cast<double>(names.size()) + 0.16 * (static_cast<double>(r) - 1.5);
      drawn[r].rows << place << ' ' << all.too_small() << ' ' << median << ' ' << low << ' ' << high << '\n';
    }
    names.push_back(map->definition.name);
  }
  table.print(std::cout);
  if (auto done = output.write(table, "lab-local-error"); !done) return done;
  return output.draw(picture(names, drawn), "lab-local-error", 1300, 1000);
}

core::Expected<void> measure_tolerance(const std::filesystem::path& folder, const Output& output) {
  const auto maps = maps_of(folder);
  if (!maps) return tl::unexpected(maps.error());
  const bool quick = output.effort() == Effort::kQuick;
  const std::size_t count = quick ? 4 : 12, ticks = quick ? 12 : 120;
  constexpr std::array kBorne = {1e-2, 1e-4, 1e-6};
  constexpr std::array kTicksPerSecond = {15, 60};
  Table table(
      {"map", "rate", "tolerance", "ticks", "beyond", "error_median", "error_99_of_100", "error_worst"});
  constexpr std::size_t kRows = kTicksPerSecond.size() * kBorne.size();  // of a map
  std::vector<const map::Map*> measured;
  for (const auto& map : *maps) {
    if (map->definition.physics.equations == state::Equations::kExact) measured.push_back(map.get());
  }
  Progress progress("tolerances", measured.size() * kRows);
  std::vector<LocalErrors> errors(measured.size() * kRows);
  const auto rate_of = [&](std::size_t i) { return kTicksPerSecond[i % kRows / kBorne.size()]; };
  const auto tolerance_of = [&](std::size_t i) { return kBorne[i % kBorne.size()]; };
  side_by_side(
      errors.size(),
      [&](std::size_t i) {
        const map::Map& map = *measured[i / kRows];
        const std::vector<state::Louse> lice = starting_lice(map, count, 5);
        for (const Play play : kPlays)
          errors[i].add(local_errors(with_tolerance(map, tolerance_of(i)), lice, play, rate_of(i), ticks, 1));
      },
      [&] { progress.advance(); });
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const LocalErrors& all = errors[i];
    const double rate = rate_of(i), borne = tolerance_of(i) / rate;  // [m] by a tick
    const auto beyond =
        std::count_if(all.truths.begin(), all.truths.end(), [&](double e) { return e > borne; });
    table.add({measured[i / kRows]->definition.name, rate, tolerance_of(i),
               static_cast<double>(all.truths.size()),
               static_cast<double>(beyond) / static_cast<double>(std::max<std::size_t>(1, all.truths.size())),
               at(all.truths, 0.5) * rate, at(all.truths, 0.99) * rate, at(all.truths, 1.0) * rate});
  }
  table.print(std::cout);
  return output.write(table, "lab-tolerance");
}

}  // namespace woodlouse::lab
