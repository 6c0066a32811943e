// 2.3: the trajectory of a celestial body, F = -x / r^3, by False Euler and by standard Euler.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "bench/lab/figures/figures.h"
#include "bench/lab/figures/plotting.h"
#include "bench/lab/problems/flat_ground.h"
#include "bench/lab/problems/kepler_ellipse.h"
#include "shared/physics/central_gravity.h"

namespace woodlouse::lab {
namespace {

constexpr double kPull = 1.0;      // "without masses and gravitational constant"
constexpr double kPeriods = 10.0;  // of the ellipse
constexpr double kWidth = 920, kHeight = 490;

std::vector<std::vector<double>> outline(const KeplerEllipse& ellipse) {
  constexpr int kPoints = 200;
  std::vector<std::vector<double>> rows;
  for (int i = 0; i <= kPoints; ++i) {
    const core::Vec2 p = ellipse.position_at(ellipse.period() * i / kPoints);
    rows.push_back({p.x, p.y});
  }
  return rows;
}

std::string panel(const std::string& title, const std::vector<PathPoint>& path, double left) {
  std::ostringstream script;
  script << place(left, 70, 370, 370, kWidth, kHeight) << data_block("$path", plan_of(path)) << "set title '"
         << title << "' noenhanced\n"
         << "plot $path using 1:2 with lines lc rgb '#107030' lw 1 title 'body', $ellipse using 1:2 with "
            "lines lc rgb '#c02020' lw 1.2 dt 2 title \"Kepler's ellipse\", $sun using 1:2 with points pt 7 "
            "ps 1.2 lc rgb '#e0a000' title 'centre', $start using 1:2 with points pt 7 ps 0.7 lc rgb "
            "'#1a50b0' title 'start'\n";
  return script.str();
}

}  // namespace

core::Expected<void> draw_planet(const Output& output, Findings& findings) {
  const KeplerEllipse ellipse(kPull, 1.0, 0.8);
  const document::AnySurface ground = flat_ground();
  state::Parameters parameters{0.0, 0.0, 0.0, 0.0, 1.0};
  parameters.central_gravity = kPull;
  parameters.core_radius = physics::default_core_radius(kPull);
  const double periods = output.quick ? 2.0 : kPeriods;
  const Journey journey{ellipse.start(), ellipse.velocity(), kFrameRate, periods * ellipse.period()};
  Table table({"integrator", "t", "x", "y", "vx", "vy", "energy", "angular_momentum"});
  std::ostringstream script;
  script << data_block("$ellipse", outline(ellipse)) << data_block("$sun", {{0.0, 0.0}})
         << data_block("$start", {{ellipse.start().x, ellipse.start().y}})
         << "set multiplot\nset tics out nomirror\nset xtics 1\nset ytics 1\nset grid lc rgb '#e8e8e8'\n"
         << "set xlabel 'x [m]' offset 0,0.4\nset ylabel 'y [m]' offset 1.5,0\nset key bottom right samplen "
            "2 font ',9'\n";
  for (const Integrator integrator : {Integrator::kFalseEuler, Integrator::kExplicitEuler}) {
    const bool is_false = integrator == Integrator::kFalseEuler;
    // The document's equations know gravity alone; on flat ground the exact ones add nothing to the pull.
    const auto path = path_over(ground, {Equations::kSurface, integrator}, parameters, journey);
    if (!path) return tl::unexpected(path.error());
    double worst = 0.0, worst_momentum = 0.0;
    const double momentum = KeplerEllipse::angular_momentum(ellipse.start(), ellipse.velocity());
    for (const PathPoint& p : *path) {
      const double energy = ellipse.energy(p.position, p.velocity);
      const double turning = KeplerEllipse::angular_momentum(p.position, p.velocity);
      worst = std::max(worst, std::fabs(energy / ellipse.energy() - 1.0));
      worst_momentum = std::max(worst_momentum, std::fabs(turning / momentum - 1.0));
      table.add({std::string(to_text(integrator)), p.t, p.position.x, p.position.y, p.velocity.x,
                 p.velocity.y, energy, turning});
    }
    const std::string name = is_false ? "False Euler" : "standard Euler";
    findings.note("2.3", name + ", " + short_text(periods) + " periods: energy off by at most", 100.0 * worst,
                  "%");
    findings.note("2.3", name + ", " + short_text(periods) + " periods: angular momentum off by at most",
                  100.0 * worst_momentum, "%");
    script << (is_false ? "set xrange [-0.8:1.3]\nset yrange [-1.05:1.05]\nset xtics 0.5\nset ytics 0.5\n"
                        : "set xrange [-2:5]\nset yrange [-3.5:3.5]\nset xtics 1\nset ytics 1\n")
           << panel(name + ", " + short_text(periods) + " periods, steps of 1/85 s", *path,
                    is_false ? 75 : 530);
  }
  script << "unset multiplot\n";
  if (auto done = output.draw(script.str(), "document-2.3-planet", static_cast<int>(kWidth),
                              static_cast<int>(kHeight));
      !done)
    return done;
  return output.write(table, "document-2.3");
}

}  // namespace woodlouse::lab
