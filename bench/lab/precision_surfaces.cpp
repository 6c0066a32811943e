#include "bench/lab/precision_surfaces.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <sstream>
#include <variant>
#include <vector>

#include "bench/lab/problems/motion.h"
#include "bench/lab/report/progress.h"
#include "bench/lab/report/race.h"
#include "shared/core/random.h"

namespace woodlouse::lab {
namespace {

using document::Interpolation;
using terrain::FunctionName;
using terrain::FunctionSurface;

constexpr double kInner = 0.8;  // of the domain: what the ends do not reach
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// What is interpolated. `periodic` gets the one there is that wraps smoothly: the waves of wavy_pot without
/// its bowl.
struct Truth {
  FunctionSurface surface;
  bool waves_alone;

  [[nodiscard]] terrain::SurfaceSample sample(double x, double y) const {
    terrain::SurfaceSample s = surface.sample(x, y);
    if (!waves_alone) return s;
    const terrain::SurfaceSample bowl = FunctionSurface(FunctionName::kParabolicPot, 1.0).sample(x, y);
    return {
        {s.z - bowl.z, s.zx - bowl.zx, s.zy - bowl.zy}, s.zxx - bowl.zxx, s.zxy - bowl.zxy, s.zyy - bowl.zyy};
  }
  [[nodiscard]] terrain::HeightGrid grid(std::size_t g) const {
    terrain::HeightGrid result = terrain::sample_function(surface.name(), 1.0, g);
    if (!waves_alone) return result;
    const terrain::HeightGrid bowl = terrain::sample_function(FunctionName::kParabolicPot, 1.0, g);
    for (std::size_t i = 0; i < bowl.heights.size(); ++i) result.heights[i] -= bowl.heights[i];
    return result;
  }
};

struct Errors {
  double value = 0.0, value_inner = 0.0, gradient = 0.0, gradient_inner = 0.0, hessian_inner = 0.0;
};

void raise(double& most, double value) { most = std::fmax(most, value); }

/// The largest errors over random points, NaN where there is no Hessian.
Errors errors_of(const document::AnySurface& any, const Truth& truth, std::size_t points) {
  return std::visit(
      [&]<typename S>(const S& surface) {
        Errors e;
        core::Random random(5);
        for (std::size_t i = 0; i < points; ++i) {
          const double x = 2.0 * random.uniform() - 1.0;
          const double y = 2.0 * random.uniform() - 1.0;
          const terrain::SurfaceSample s = surface.sample(x, y);
          const terrain::SurfaceSample t = truth.sample(x, y);
          const double value = std::fabs(s.z - t.z);
          const double gradient = std::hypot(s.zx - t.zx, s.zy - t.zy);
          raise(e.value, value);
          raise(e.gradient, gradient);
          if (std::fmax(std::fabs(x), std::fabs(y)) > kInner) continue;
          raise(e.value_inner, value);
          raise(e.gradient_inner, gradient);
          raise(e.hessian_inner, std::fmax(std::fabs(s.zxx - t.zxx),
                                           std::fmax(std::fabs(s.zxy - t.zxy), std::fabs(s.zyy - t.zyy))));
        }
        if (!terrain::kHasHessian<S>) e.hessian_inner = kNone;
        return e;
      },
      any);
}

Contestant sampler(const document::AnySurface& surface, const std::vector<core::Vec2>& points) {
  const auto run = [&surface, &points] {
    std::visit(
        [&](const auto& s) {
          double sum = 0.0;
          for (const core::Vec2 p : points) {
            const terrain::SurfaceSample at = s.sample(p.x, p.y);
            sum += at.z + at.zx + at.zy + at.zxx + at.zxy + at.zyy;
          }
          keep(sum);
        },
        surface);
  };
  return {"", run, static_cast<double>(points.size())};
}

double order(double coarse, double fine) {
  return fine > 0.0 && coarse > 0.0 ? std::log2(coarse / fine) : kNone;
}

std::string picture(const Table& table) {
  std::ostringstream script;
  script << "set logscale xy\nset format x '10^{%L}'\nset format y '10^{%L}'\nset grid\n"
         << "set multiplot layout 1,2\n";
  const auto panel = [&](std::size_t x_column, std::size_t y_column) {
    std::ostringstream plots;
    std::size_t index = 0;
    for (const Interpolation interpolation : document::kInterpolations) {
      const std::string block = "$d" + std::to_string(index);
      script << block << " << EOD\n";
      for (const auto& row : table.rows()) {
        if (std::get<std::string>(row[0]) != to_text(interpolation)) continue;
        script << std::get<double>(row[x_column]) << ' ' << std::get<double>(row[y_column]) << '\n';
      }
      script << "EOD\n";
      plots << (index == 0 ? "plot " : ", ") << block << " with linespoints lw 1.5 pt " << index + 4
            << " ps 0.6 title '" << to_text(interpolation) << "' noenhanced";
      ++index;
    }
    script << plots.str() << '\n';
  };
  script << "set title 'run time against error'\nset xlabel 'ns per evaluation, random order'\n"
         << "set ylabel 'largest gradient error, inner 80 %'\nunset key\n";
  panel(2, 6);
  script << "set title 'the rim included'\nset xlabel 'knots a side'\nset ylabel 'largest value error, whole "
            "domain'\nset key outside right top font ',9'\n";
  panel(1, 3);
  return script.str() + "unset multiplot\n";
}

}  // namespace

core::Expected<void> measure_surfaces(FunctionName function, const Output& output) {
  const bool quick = output.effort() == Effort::kQuick;
  const std::vector<std::size_t> grids =
      quick ? std::vector<std::size_t>{10, 20} : std::vector<std::size_t>{5, 10, 20, 40, 80, 160};
  std::vector<core::Vec2> points;
  core::Random random(7);
  for (int i = 0; i < 1024; ++i)
    points.push_back({2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0});

  struct Entry {
    Interpolation interpolation;
    std::size_t grid;
    document::AnySurface surface;
    Errors errors;
  };
  std::vector<Entry> entries;
  {
    Progress progress("errors of surfaces", document::kInterpolations.size() * grids.size());
    for (const Interpolation interpolation : document::kInterpolations) {
      const bool wraps = interpolation == Interpolation::kPeriodic;
      const Truth truth{FunctionSurface(wraps ? FunctionName::kWavyPot : function, 1.0), wraps};
      for (const std::size_t grid : grids) {
        auto surface = document::interpolate(interpolation, truth.grid(grid));
        if (!surface) return tl::unexpected(surface.error());
        const bool slow = interpolation == Interpolation::kNaturalDocument;
        const Errors errors = errors_of(*surface, truth, quick || slow ? 4000 : 40000);
        entries.push_back({interpolation, grid, std::move(*surface), errors});
        progress.advance();
      }
    }
  }
  std::vector<Contestant> contestants;
  for (const Entry& entry : entries) contestants.push_back(sampler(entry.surface, points));
  const std::vector<Timing> times = race(contestants, output.effort(), "times of surfaces");

  Table table({"surface", "knots", "ns", "value", "gradient", "value_inner", "gradient_inner",
               "hessian_inner", "order_value", "order_gradient", "order_value_inner",
               "order_gradient_inner"});
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& entry = entries[i];
    const Errors& e = entry.errors;
    const bool first = entry.grid == grids.front();
    const Errors& before = first ? e : entries[i - 1].errors;
    const auto grown = [&](double Errors::*error) { return first ? kNone : order(before.*error, e.*error); };
    table.add({std::string(to_text(entry.interpolation)), static_cast<double>(2 * entry.grid + 1),
               times[i].median_ns, e.value, e.gradient, e.value_inner, e.gradient_inner, e.hessian_inner,
               grown(&Errors::value), grown(&Errors::gradient), grown(&Errors::value_inner),
               grown(&Errors::gradient_inner)});
  }
  std::cout << "\nSurfaces of " << to_text(function)
            << " (periodic: of its waves alone), largest errors, inner: |x|, |y| <= " << kInner << '\n';
  table.print(std::cout);
  if (auto done = output.write(table, "lab-precision-surfaces"); !done) return done;
  return output.draw(picture(table), "lab-precision-surfaces", 1300, 600);
}

}  // namespace woodlouse::lab
