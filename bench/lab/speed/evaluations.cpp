#include "bench/lab/speed/evaluations.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/lab/methods/lanes.h"
#include "bench/lab/methods/rival.h"
#include "bench/lab/report/race.h"
#include "shared/core/random.h"
#include "shared/document/surface_catalogue.h"

namespace woodlouse::lab {
namespace {

constexpr double kNotRun = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kPoints = 4096;

/// Random points jump anywhere; coherent ones follow one slow walk; a flock is 64 lice, each on a slow walk
/// of its own, taken in turn: what a room does.
enum class Order { kRandom, kCoherent, kFlock };
constexpr std::array kOrders = {Order::kRandom, Order::kCoherent, Order::kFlock};

std::string to_text(Order order) {
  return order == Order::kRandom ? "random" : order == Order::kCoherent ? "coherent" : "flock";
}

std::vector<core::Vec2> points_in(Order order) {
  constexpr double kStride = 0.0005;  // of the domain's half side: a fiftieth to a half of a cell
  constexpr std::size_t kFlock = 64;
  core::Random random(1);
  const auto symmetric = [&] { return 2.0 * random.uniform() - 1.0; };
  const std::size_t walkers = order == Order::kFlock ? kFlock : 1;
  std::vector<core::Vec2> at(walkers);
  for (core::Vec2& p : at) p = {0.9 * symmetric(), 0.9 * symmetric()};
  std::vector<core::Vec2> points;
  for (std::size_t i = 0; i < kPoints; ++i) {
    if (order == Order::kRandom) {
      points.push_back({0.999 * symmetric(), 0.999 * symmetric()});
      continue;
    }
    core::Vec2& p = at[i % walkers];
    p.x = std::fmin(0.999, std::fmax(-0.999, p.x + kStride * symmetric()));
    p.y = std::fmin(0.999, std::fmax(-0.999, p.y + kStride * symmetric()));
    points.push_back(p);
  }
  return points;
}

/// The same points as the lanes read them.
struct LanePoints {
  std::vector<double> x, y;
  explicit LanePoints(const std::vector<core::Vec2>& points) {
    for (const core::Vec2 p : points) x.push_back(p.x), y.push_back(p.y);
  }
};

enum class Wanted { kGradient, kHessian };

/// Surfaces are sampled inlined: what is not wanted, the compiler leaves out.
template <Wanted kWanted, typename S>
double sum_of(const S& surface, std::span<const core::Vec2> points) {
  double total = 0.0;
  for (const core::Vec2 p : points) {
    const terrain::SurfaceSample s = surface.sample(p.x, p.y);
    total += s.z + s.zx + s.zy;
    if constexpr (kWanted == Wanted::kHessian) total += s.zxx + s.zxy + s.zyy;
  }
  return total;
}

/// Everything that is compared at one number of knots.
struct Field {
  terrain::HeightGrid grid;
  terrain::BicubicSpline spline;
  terrain::TiledBSpline bspline;
  document::Spline papers;
  document::Biquadratic biquadratic;
  document::Blended blended;
  document::GaussGradient gauss;
  std::unique_ptr<Rival> gsl_six, gsl_three, alglib, vspline;

  explicit Field(std::size_t g)
      : grid(terrain::sample_function(terrain::FunctionName::kVolcano, 1.0, g)),
        spline(grid),
        bspline(grid),
        papers(grid),
        biquadratic(grid),
        blended(grid),
        gauss(grid),
        gsl_six(gsl_six_calls(grid)),
        gsl_three(gsl_three_calls(grid)),
        alglib(alglib_differentiation(grid)),
        vspline(vspline_six_evaluators(grid)) {}
};

/// One line of the table; no contestant: `note` says why.
struct Entry {
  std::string name;
  std::string computes;
  std::function<double(std::span<const core::Vec2>, const LanePoints&)> sum;
  std::string note;
  std::size_t points = kPoints;  ///< of a block; less for what is slow
};

template <Wanted kWanted, typename S>
Entry ours(std::string name, const S& surface, std::size_t points = kPoints) {
  return {
      std::move(name), kWanted == Wanted::kHessian ? "z+G+H" : "z+G",
      [&surface](std::span<const core::Vec2> p, const LanePoints&) { return sum_of<kWanted>(surface, p); },
      "", points};
}

Entry rival(std::string name, std::string computes, const std::unique_ptr<Rival>& rival) {
  if (rival == nullptr) return {std::move(name), std::move(computes), {}, "not built"};
  return {std::move(name), std::move(computes),
          [&rival](std::span<const core::Vec2> p, const LanePoints&) { return rival->sum(p); }, ""};
}

Entry lanes(const Field& field, physics::InstructionSet set) {
  const std::string name = std::string("spline ") + physics::to_text(set);
  const LaneEvaluation evaluation = find_lane_evaluation(set);
  if (evaluation.width == 0) return {name, "z+G+H", {}, "not run"};
  return {name, "z+G+H",
          [&field, evaluation](std::span<const core::Vec2>, const LanePoints& p) {
            return evaluation.sum(field.spline.view(), p.x.data(), p.y.data(), p.x.size());
          },
          ""};
}

std::vector<Entry> entries_of(const Field& f) {
  std::vector<Entry> result;
  result.push_back(ours<Wanted::kHessian>("spline", f.spline));
  result.push_back(ours<Wanted::kGradient>("spline", f.spline));
  result.push_back(lanes(f, physics::InstructionSet::kAvx2));
  result.push_back(lanes(f, physics::InstructionSet::kAvx512));
  result.push_back(ours<Wanted::kHessian>("bspline", f.bspline));
  result.push_back(ours<Wanted::kGradient>("biquadratic", f.biquadratic));
  result.push_back(ours<Wanted::kGradient>("blended", f.blended));
  result.push_back(ours<Wanted::kGradient>("gauss", f.gauss));
  result.push_back(rival("GSL spline2d", "z+G+H", f.gsl_six));
  result.push_back(rival("GSL spline2d", "z+G", f.gsl_three));
  result.push_back(rival("ALGLIB spline2ddiff", "z+G", f.alglib));
  result.push_back(rival("vspline", "z+G+H", f.vspline));
  result.push_back(ours<Wanted::kGradient>("the document's", f.papers, 32));
  return result;
}

using Measured = std::map<std::string, double>;  // "name computes" -> ns

Measured measure(const Field& field, std::size_t knots, Order order, Effort effort, Table& table) {
  const std::vector<core::Vec2> points = points_in(order);
  const LanePoints lane_points(points);
  const std::vector<Entry> entries = entries_of(field);
  std::vector<Contestant> contestants;
  for (const Entry& entry : entries) {
    if (!entry.sum) continue;
    const auto run = [&entry, &points, &lane_points] {
      keep(entry.sum(std::span(points).first(entry.points), lane_points));
    };
    contestants.push_back({entry.name, run, static_cast<double>(entry.points)});
  }
  const std::vector<Timing> times =
      race(contestants, effort, std::to_string(knots) + " knots, " + to_text(order));
  Measured measured;
  std::size_t next = 0;
  for (const Entry& entry : entries) {
    const Timing time = entry.sum ? times[next++] : Timing{kNotRun, kNotRun};
    if (entry.sum) measured[entry.name + " " + entry.computes] = time.median_ns;
    table.add({entry.name, entry.computes, static_cast<double>(knots), to_text(order), time.median_ns,
               time.best_ns, entry.note});
  }
  return measured;
}

void add_ratio(Table& ratios, const Measured& m, const std::string& ours, const std::string& theirs,
               std::size_t knots, Order order) {
  const auto a = m.find(ours);
  const auto b = m.find(theirs);
  if (a == m.end() || b == m.end()) {
    ratios.add(
        {theirs + " / " + ours, static_cast<double>(knots), to_text(order),
         std::string(b == m.end() && theirs.find("avx") == std::string::npos ? "not built" : "not run")});
    return;
  }
  ratios.add({theirs + " / " + ours, static_cast<double>(knots), to_text(order), b->second / a->second});
}

}  // namespace

LaneEvaluation find_lane_evaluation(physics::InstructionSet set) {
#ifdef WOODLOUSE_X86_LANES
  if (set == physics::InstructionSet::kAvx2 && physics::is_available(set)) return avx2_evaluation();
  if (set == physics::InstructionSet::kAvx512 && physics::is_available(set)) return avx512_evaluation();
#else
  static_cast<void>(set);
#endif
  return {};
}

core::Expected<void> measure_evaluations(const Output& output) {
  const std::vector<std::size_t> sizes =
      output.quick ? std::vector<std::size_t>{21, 201} : std::vector<std::size_t>{21, 201, 1001};
  Table table({"surface", "computes", "knots", "order", "ns", "ns_best", "note"});
  Table ratios({"ratio", "knots", "order", "times"});
  for (const std::size_t knots : sizes) {
    const auto field = std::make_unique<Field>((knots - 1) / 2);
    for (const Order order : kOrders) {
      const Measured m = measure(*field, knots, order, output.effort(), table);
      add_ratio(ratios, m, "spline z+G+H", "GSL spline2d z+G+H", knots, order);
      add_ratio(ratios, m, "spline z+G", "ALGLIB spline2ddiff z+G", knots, order);
      add_ratio(ratios, m, "spline avx2 z+G+H", "vspline z+G+H", knots, order);
      add_ratio(ratios, m, "spline z+G", "the document's z+G", knots, order);
      add_ratio(ratios, m, "spline avx512 z+G+H", "spline z+G+H", knots, order);
    }
  }
  std::cout << "Evaluations of volcano's knots (natural ends: GSL, ALGLIB, vspline, the document's; "
               "not-a-knot: ours)\n";
  table.print(std::cout);
  std::cout << '\n';
  ratios.print(std::cout);
  return output.write(table, "lab-speed-evaluations");
}

}  // namespace woodlouse::lab
