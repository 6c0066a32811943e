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
#include "bench/lab/speed/maps.h"

namespace woodlouse::lab {
namespace {

using MapPointer = std::shared_ptr<const map::Map>;

/// The rooms' methods, and the two that cost or promise most of the others.
constexpr std::array kGameMethods = {Integrator::kNystrom4, Integrator::kVerletQ, Integrator::kPrecise,
                                     Integrator::kRungeKutta4, Integrator::kDormandPrince5};

struct Size {
  std::size_t lice;
  double seconds;
  std::vector<int> rates;
};

Size size_of(Effort effort) {
  if (effort == Effort::kQuick) return {4, 1.2, {15, 60}};
  return {12, 4.0, {kGameRates.begin(), kGameRates.end()}};
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
std::optional<Measured> measure(const map::Map& map, const std::vector<state::Louse>& lice,
                                Integrator integrator, Play play, int rate, const Size& size,
                                const Truths& truths) {
  const auto world = world_of(map, integrator, rate);
  if (world == nullptr) return std::nullopt;
  world->restore(lice);
  const auto ticks = static_cast<std::uint64_t>(std::lround(size.seconds * rate));
  Measured result;
  if (room_method(integrator)) {
    const auto scalar = world_of(map, integrator, rate);
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
};
using Pools = std::map<std::pair<Integrator, int>, Pool>;

/// All plays of one map; rows of `table`.
Pools measure_errors(const map::Map& map, const Size& size, Table& table, Progress& progress,
                     bool& same_bits) {
  Pools pools;
  const std::vector<state::Louse> lice = starting_lice(map, size.lice, 3);
  for (const Play play : kPlays) {
    std::optional<Truths> shared;
    for (const int rate : size.rates) {
      if (is_of_ticks(play) || !shared) shared = truths(map, lice, play, rate, size.seconds);
      for (const Integrator integrator : kGameMethods) {
        const auto one = measure(map, lice, integrator, play, rate, size, *shared);
        if (!one) continue;
        same_bits = same_bits && one->same_bits;
        table.add({map.definition.name, std::string(to_text(play)), std::string(to_text(integrator)),
                   static_cast<double>(rate), one->sub_steps, one->errors.at(0.5), one->errors.at(0.9),
                   one->errors.at(1.0), shared->doubts.at(1.0), shared->unforeseen()});
        Pool& pool = pools[{integrator, rate}];
        (is_along_heading(play) ? pool.headings : pool.vectors).add(one->errors);
      }
    }
    progress.advance();
  }
  return pools;
}

/// A method's time of a louse and simulated second [ns], in lanes and one by one.
struct Times {
  double lanes = 0.0, plain = 0.0;
};

/// 32 lice that are pushed over a vector, 0.4 s of it again and again. Five rounds: their medians are for
/// axes of decades.
std::map<std::pair<Integrator, int>, Times> measure_times(const map::Map& map, const Size& size) {
  constexpr std::size_t kLice = 32;
  constexpr double kSeconds = 0.4;
  const std::vector<state::Louse> lice = starting_lice(map, kLice, 4);
  std::vector<Contestant> contestants;
  std::vector<std::pair<std::pair<Integrator, int>, bool>> names;
  for (const Integrator integrator : kGameMethods) {
    for (const int rate : size.rates) {
      for (const bool in_lanes : {true, false}) {
        const std::shared_ptr<physics::World> world = world_of(map, integrator, rate);
        if (world == nullptr) continue;
        if (!in_lanes) world->use(physics::InstructionSet::kScalar);
        const auto run = [world, &lice, rate] {
          world->restore(lice);
          play_on(*world, Play::kHeldVector, rate, 0,
                  static_cast<std::uint64_t>(std::lround(kSeconds * rate)));
        };
        contestants.push_back({"", run, kLice * kSeconds});
        names.push_back({{integrator, rate}, in_lanes});
      }
    }
  }
  const std::vector<Timing> timings = race(contestants, Effort::kQuick, "times on " + map.definition.name);
  std::map<std::pair<Integrator, int>, Times> times;
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
  Table table({"map", "play", "integrator", "rate", "sub_steps", "error_median", "error_9_of_10",
               "error_worst", "doubt_worst", "unforeseen"});
  Table work({"map", "integrator", "rate", "ns_per_second", "ns_plain_doubles", "vectors_median",
              "vectors_9_of_10", "headings_median", "headings_9_of_10"});
  std::vector<GamePanel> panels;
  bool same_bits = true;
  Progress progress("errors on maps", maps->size() * kPlays.size());
  for (const MapPointer& map : *maps) {
    if (!is_measured(*map)) continue;
    const Pools pools = measure_errors(*map, size, table, progress, same_bits);
    const auto times = measure_times(*map, size);
    GamePanel panel{map->definition.name, {}};
    for (const Integrator integrator : kGameMethods) {
      GameCurve curve{std::string(to_text(integrator)), {}};
      for (const int rate : size.rates) {
        const auto pool = pools.find({integrator, rate});
        if (pool == pools.end()) continue;
        const auto& [vectors, headings] = pool->second;
        const Times& t = times.at({integrator, rate});
        work.add({map->definition.name, curve.name, static_cast<double>(rate), t.lanes, t.plain,
                  vectors.at(0.5), vectors.at(0.9), headings.at(0.5), headings.at(0.9)});
        curve.points.push_back({t.lanes, vectors.at(0.5), integrator == Integrator::kNystrom4 && rate == 60});
      }
      panel.curves.push_back(std::move(curve));
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
