#include "bench/lab/game/precision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/lab/game/panels.h"
#include "bench/lab/game/scene.h"
#include "bench/lab/report/progress.h"
#include "bench/lab/report/race.h"
#include "bench/lab/report/side_by_side.h"
#include "bench/lab/speed/maps.h"

namespace woodlouse::lab {
namespace {

/// The rooms' methods, and the two that cost or promise most of the others.
constexpr std::array kGameMethods = {Integrator::kNystrom4, Integrator::kVerletQ, Integrator::kPrecise,
                                     Integrator::kRungeKutta4, Integrator::kDormandPrince5};

struct Size {
  std::size_t lice;
  double seconds;
  std::vector<int> rates;
  std::vector<double> tolerances;  ///< of the default at its rate [m/s of play]
};

Size size_of(Effort effort) {
  if (effort == Effort::kQuick) return {4, 1.2, {15, 60}, {1e-4, 1e-7}};
  return {12, 4.0, {kGameRates.begin(), kGameRates.end()}, {kTolerances.begin(), kTolerances.end()}};
}

/// A method at one rate; tolerance: a map's, 0 where steps don't ask.
struct Run {
  Integrator integrator;
  int rate;
  double tolerance = 0.0;
  friend auto operator<=>(const Run&, const Run&) = default;
};
constexpr int kUsualRate = 60;

/// Of each method and tolerance those of all rates, one after the other.
std::vector<Run> runs_of(const Size& size) {
  std::vector<Run> runs;
  for (const Integrator integrator : kGameMethods) {
    for (const int rate : size.rates) runs.push_back({integrator, rate});
  }
  for (const double tolerance : size.tolerances)
    runs.push_back({Integrator::kNystrom4, kUsualRate, tolerance});
  return runs;
}

/// Of its curve in the picture.
std::string name_of(const Run& run) {
  return run.tolerance > 0.0 ? "tolerance" : std::string(to_text(run.integrator));
}

std::unique_ptr<physics::World> world_of(const map::Map& map, const Run& run) {
  return world_of(with_tolerance(map, run.tolerance), run.integrator, run.rate);
}

/// Errors of many lice [m].
class Errors {
 public:
  void add(double error) { errors_.push_back(error); }
  void add(const Errors& others) {
    errors_.insert(errors_.end(), others.errors_.begin(), others.errors_.end());
  }
  /// The value below which that share of them lies.
  [[nodiscard]] double at(double share) const {
    if (errors_.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::vector<double> sorted = errors_;
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }

 private:
  std::vector<double> errors_;
};

/// Beyond which doubt [m] a way can't be foreseen: it hangs on a digit that no step could know, as a
/// heading's does where a louse that rolls backwards turns.
constexpr double kForeseeable = 1e-10;

/// Where lice should be, by care and by a hundred times less of it.
struct Truths {
  std::vector<reference::Motion> ways;
  std::vector<bool> foreseen;
  Errors doubts;  ///< what the lesser care changes, of those that can be foreseen [m]
  [[nodiscard]] double unforeseen() const {
    return static_cast<double>(std::count(foreseen.begin(), foreseen.end(), false));
  }
};

Truths truths(const map::Map& map, const std::vector<state::Louse>& lice, Play play, int rate,
              double seconds) {
  Truths result;
  for (const state::Louse& start : lice) {
    const reference::Care care;
    reference::Care less = care;
    less.tolerance *= 100;
    less.longest *= 0.7L;
    result.ways.push_back(true_way(map, start, play, rate, seconds, care));
    const reference::Motion other = true_way(map, start, play, rate, seconds, less);
    const auto a = result.ways.back().position(), b = other.position();
    const double doubt = static_cast<double>(std::hypot(a.x - b.x, a.y - b.y));
    result.foreseen.push_back(doubt < kForeseeable && !result.ways.back().gave_up() && !other.gave_up());
    if (result.foreseen.back()) result.doubts.add(doubt);
  }
  return result;
}

struct Measured {
  Errors errors;
  double sub_steps = 0.0;  ///< a tick
  bool same_bits = true;   ///< in lanes and by plain doubles
};

/// By one method at one rate.
std::optional<Measured> measure(const map::Map& map, const std::vector<state::Louse>& lice, const Run& run,
                                Play play, const Size& size, const Truths& truths) {
  const int rate = run.rate;
  const auto world = world_of(map, run);
  if (world == nullptr) return std::nullopt;
  world->restore(lice);
  const auto ticks = static_cast<std::uint64_t>(std::lround(size.seconds * rate));
  Measured result;
  if (room_method(run.integrator)) {
    const auto scalar = world_of(map, run);
    scalar->use(physics::InstructionSet::kScalar);
    scalar->restore(lice);
    play_on(*scalar, play, rate, 0, ticks);
    play_on(*world, play, rate, 0, ticks);
    result.same_bits = std::equal(world->lice().begin(), world->lice().end(), scalar->lice().begin());
  } else {
    play_on(*world, play, rate, 0, ticks);
  }
  for (std::size_t i = 0; i < lice.size(); ++i) {
    if (truths.foreseen[i]) result.errors.add(error_of(map, world->lice()[i], truths.ways[i]));
  }
  result.sub_steps = static_cast<double>(world->counters().sub_steps) /
                     static_cast<double>(std::max<std::uint64_t>(1, world->counters().louse_steps));
  return result;
}

/// Of the plays by vectors, which every method was made for, and of those along headings.
struct Pool {
  Errors vectors, headings;
  void add(const Pool& others) {
    vectors.add(others.vectors);
    headings.add(others.headings);
  }
};
using Pools = std::map<Run, Pool>;

/// What one play of one map came to.
struct Played {
  std::vector<std::vector<Table::Cell>> rows;
  Pools pools;
  bool same_bits = true;
};

Played measure_errors(const map::Map& map, Play play, const Size& size) {
  Played played;
  const std::vector<state::Louse> lice = starting_lice(map, size.lice, 3);
  const std::vector<Run> runs = runs_of(size);
  std::optional<Truths> shared;
  for (const int rate : size.rates) {
    if (is_of_ticks(play) || !shared) shared = truths(map, lice, play, rate, size.seconds);
    for (const Run& run : runs) {
      if (run.rate != rate) continue;
      const auto one = measure(map, lice, run, play, size, *shared);
      if (!one) continue;
      played.same_bits = played.same_bits && one->same_bits;
      played.rows.push_back({map.definition.name, std::string(to_text(play)),
                             std::string(to_text(run.integrator)), static_cast<double>(rate), run.tolerance,
                             one->sub_steps, one->errors.at(0.5), one->errors.at(0.9), one->errors.at(1.0),
                             shared->doubts.at(1.0), shared->unforeseen()});
      Pool& pool = played.pools[run];
      (is_along_heading(play) ? pool.headings : pool.vectors).add(one->errors);
    }
  }
  return played;
}

/// By map, then by play.
std::vector<Played> measure_errors(const std::vector<const map::Map*>& maps, const Size& size) {
  std::vector<Played> all(maps.size() * kPlays.size());
  Progress progress("errors on maps", all.size());
  side_by_side(
      all.size(),
      [&](std::size_t i) {
        all[i] = measure_errors(*maps[i / kPlays.size()], kPlays[i % kPlays.size()], size);
      },
      [&] { progress.advance(); });
  return all;
}

/// A method's time of a louse and simulated second [ns], in lanes and one by one.
struct Times {
  double lanes = 0.0, plain = 0.0;
};

/// 32 lice that are pushed over a vector, 0.4 s of it again and again. Five rounds: their medians are for
/// axes of decades.
std::map<Run, Times> measure_times(const map::Map& map, const Size& size) {
  constexpr std::size_t kLice = 32;
  constexpr double kSeconds = 0.4;
  const std::vector<state::Louse> lice = starting_lice(map, kLice, 4);
  std::vector<Contestant> contestants;
  std::vector<std::pair<Run, bool>> names;
  for (const Run& run : runs_of(size)) {
    for (const bool in_lanes : {true, false}) {
      const std::shared_ptr<physics::World> world = world_of(map, run);
      if (world == nullptr) continue;
      if (!in_lanes) world->use(physics::InstructionSet::kScalar);
      const auto play = [world, &lice, rate = run.rate] {
        world->restore(lice);
        play_on(*world, Play::kHeldVector, rate, 0, static_cast<std::uint64_t>(std::lround(kSeconds * rate)));
      };
      contestants.push_back({"", play, kLice * kSeconds});
      names.push_back({run, in_lanes});
    }
  }
  const std::vector<Timing> timings = race(contestants, Effort::kQuick, "times on " + map.definition.name);
  std::map<Run, Times> times;
  for (std::size_t i = 0; i < names.size(); ++i) {
    Times& t = times[names[i].first];
    (names[i].second ? t.lanes : t.plain) = timings[i].median_ns;
  }
  return times;
}

}  // namespace

core::Expected<void> measure_game_precision(const std::filesystem::path& folder, const Output& output) {
  const auto maps = maps_of(folder);
  if (!maps) return tl::unexpected(maps.error());
  const Size size = size_of(output.effort());
  Table table({"map", "play", "integrator", "rate", "tolerance", "sub_steps", "error_median", "error_9_of_10",
               "error_worst", "doubt_worst", "unforeseen"});
  Table work({"map", "integrator", "rate", "tolerance", "ns_per_second", "ns_plain_doubles", "vectors_median",
              "vectors_9_of_10", "headings_median", "headings_9_of_10"});
  std::vector<GamePanel> panels;
  bool same_bits = true;
  std::vector<const map::Map*> measured;
  for (const auto& map : *maps) {
    if (is_measured(*map)) measured.push_back(map.get());
  }
  // Before all times, which are taken with nothing beside them.
  const std::vector<Played> played = measure_errors(measured, size);
  for (std::size_t m = 0; m < measured.size(); ++m) {
    const map::Map* const map = measured[m];
    Pools pools;
    for (std::size_t p = 0; p < kPlays.size(); ++p) {
      const Played& one = played[m * kPlays.size() + p];
      for (const auto& row : one.rows) table.add(row);
      for (const auto& [run, pool] : one.pools) pools[run].add(pool);
      same_bits = same_bits && one.same_bits;
    }
    const auto times = measure_times(*map, size);
    GamePanel panel{map->definition.name, {}};
    for (const Run& run : runs_of(size)) {
      // Those it has no method for too: each curve has its colour by its place.
      if (panel.curves.empty() || panel.curves.back().name != name_of(run))
        panel.curves.push_back({name_of(run), {}});
      const auto pool = pools.find(run);
      if (pool == pools.end()) continue;
      const auto& [vectors, headings] = pool->second;
      const Times& t = times.at(run);
      work.add({map->definition.name, std::string(to_text(run.integrator)), static_cast<double>(run.rate),
                run.tolerance, t.lanes, t.plain, vectors.at(0.5), vectors.at(0.9), headings.at(0.5),
                headings.at(0.9)});
      const bool is_default = run == Run{Integrator::kNystrom4, kUsualRate};
      panel.curves.back().points.push_back({t.lanes, vectors.at(0.5), is_default});
    }
    panels.push_back(std::move(panel));
  }
  if (panels.empty())
    return core::fail(folder.string(), "no map of exact equations over a spline or a plane",
                      "name others with --maps");
  std::cout << "Maps as they are played, " << size.seconds << " s, " << size.lice << " lice of each of "
            << kPlays.size() << " kinds of steering; in lanes and by plain doubles: "
            << (same_bits ? "the same bits" : "BITS THAT DIFFER") << '\n';
  work.print(std::cout);
  if (!same_bits)
    return core::fail("precision", "lanes and plain doubles differ", "it is a bug: tell us of it");
  if (auto done = output.write(table, "lab-precision-maps"); !done) return done;
  if (auto done = output.write(work, "lab-precision-maps-time"); !done) return done;
  return output.draw(game_picture(panels), "lab-precision-maps", 1500, 1250);
}

}  // namespace woodlouse::lab
