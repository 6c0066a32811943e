// The map hoffmann_2002: the wavy pot as the document plays it (the global spline of chapter 5, the equations
// as printed, False Euler), beside the exact motion over the same ground from the same start.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bench/lab/figures/figures.h"
#include "bench/lab/figures/plotting.h"
#include "bench/lab/problems/motion.h"
#include "bench/lab/problems/reference_motion.h"

namespace woodlouse::lab {
namespace {

constexpr std::size_t kGrid = 10;   // "raw grid g=10" (5.3)
constexpr double kScale = 20.0;     ///< of the shipped maps [m]
constexpr double kTickRate = 60.0;  ///< a room's [Hz]
constexpr core::Vec2 kStart{14.0, 0.0};
constexpr core::Vec2 kVelocity{0.0, 6.0};
constexpr double kWidth = 1000, kHeight = 830;

/// Without dissipation the lab's own integration; halving its step changes 2e-12 m (docs/physics.md).
std::vector<PathPoint> reference_path(const terrain::BicubicSpline& spline, const state::Parameters& p,
                                      const Journey& journey) {
  constexpr double kStep = 1e-3;  // [s]
  physics::Motion at{journey.from, journey.velocity};
  std::vector<PathPoint> path;
  const auto points = static_cast<std::size_t>(std::llround(journey.seconds * journey.rate));
  for (std::size_t i = 0; i <= points; ++i) {
    if (i > 0) at = reference_motion(spline, at, 1.0 / journey.rate, kStep, p);
    const terrain::SurfaceSample s = spline.sample(at.position.x, at.position.y);
    path.push_back({static_cast<double>(i) / journey.rate, at.position, s.z, at.velocity,
                    energy_of(s, at.velocity, p.gravity)});
  }
  return path;
}

struct Pair {
  std::string name, title;
  std::vector<PathPoint> played, exact;
};

double furthest(const std::vector<PathPoint>& a, const std::vector<PathPoint>& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, distance(a[i].position, b[i].position));
  return worst;
}

std::string map_panel(const Pair& pair, double left) {
  std::ostringstream script;
  script
      << place(left, 335, 420, 420, kWidth, kHeight) << data_block("$played", plan_of(pair.played))
      << data_block("$exact", plan_of(pair.exact)) << data_block("$start", {{kStart.x, kStart.y}})
      << "set title '" << pair.title
      << "' noenhanced\nset xrange [-20:20]\nset yrange [-20:20]\nset xtics 10\nset ytics 10\n"
      << "set xlabel 'x [m]' offset 0,0.3\nset ylabel 'y [m]' offset 1.5,0\n"
      << "plot $lines using 1:2 with lines lc rgb '#d0d0d0' lw 0.7 notitle, $exact using 1:2 with lines lc "
         "rgb '#1a50b0' lw 1.4 title 'exact', $played using 1:2 with lines lc rgb '#107030' lw 1.2 title "
         "'as the document plays it', $start using 1:2 with points pt 7 ps 0.9 lc rgb 'black' title "
         "'start'\n";
  return script.str();
}

std::string distance_panel(const Pair& pair, double left) {
  std::vector<std::vector<double>> apart;
  for (std::size_t i = 0; i < pair.exact.size(); ++i)
    apart.push_back({pair.exact[i].t, distance(pair.exact[i].position, pair.played[i].position)});
  std::ostringstream script;
  script << place(left, 55, 420, 170, kWidth, kHeight) << data_block("$apart", apart)
         << "set title 'how far they are apart'\nset xrange [0:" << pair.exact.back().t
         << "]\nset yrange [0:*]\nset xtics auto\nset ytics auto\nset xlabel 't [s]' offset 0,0.3\n"
         << "set ylabel '[m]' offset 1.5,0\nplot $apart using 1:2 with lines lc rgb '#c02020' lw 1.3 "
            "notitle\n";
  return script.str();
}

}  // namespace

core::Expected<void> draw_as_played(const Output& output, Findings& findings) {
  const terrain::HeightGrid grid = terrain::sample_function(terrain::FunctionName::kWavyPot, kScale, kGrid);
  const auto played_on = document::interpolate(document::Interpolation::kNaturalDocument, grid);
  if (!played_on) return tl::unexpected(played_on.error());
  const auto exact_on = document::interpolate(document::Interpolation::kNatural, grid);
  if (!exact_on) return tl::unexpected(exact_on.error());
  const Journey journey{kStart, kVelocity, kTickRate, output.quick ? 5.0 : 30.0};

  std::vector<Pair> pairs;
  for (const bool dissipates : {false, true}) {
    const state::Parameters p = constants_of_integ(dissipates, dissipates);
    auto played = path_over(*played_on, kAsPrinted, p, journey);
    if (!played) return tl::unexpected(played.error());
    // With friction: the server's precise steps, sixteen a tick.
    auto exact = path_over(*exact_on, {Equations::kSurface, Integrator::kPrecise, 16}, p, journey);
    if (!exact) return tl::unexpected(exact.error());
    if (!dissipates) {
      auto reference = reference_path(std::get<terrain::BicubicSpline>(*exact_on), p, journey);
      findings.note("hoffmann_2002", "precise, 960 Hz, no dissipation: from the reference at most",
                    furthest(*exact, reference), "m");
      *exact = std::move(reference);
    }
    const std::string what = dissipates ? "drag and friction" : "no dissipation";
    findings.note("hoffmann_2002", what + ": as played from the exact path at most",
                  furthest(*played, *exact), "m");
    const auto last_speed = [](const std::vector<PathPoint>& path) {
      return std::hypot(path.back().velocity.x, path.back().velocity.y);
    };
    if (dissipates) {
      findings.note("hoffmann_2002", what + ": speed at the end, as played", last_speed(*played), "m/s");
      findings.note("hoffmann_2002", what + ": speed at the end, exact", last_speed(*exact), "m/s");
    }
    pairs.push_back({dissipates ? "both" : "none",
                     dissipates ? "With drag and friction" : "Without dissipation", std::move(*played),
                     std::move(*exact)});
  }

  std::ostringstream script;
  script << height_lines("$lines", *exact_on, 14)
         << "set multiplot\nset label 1 'hoffmann_2002: wavy pot, 21 x 21 knots, 40 m a side; document: "
            "equations as "
            "printed, False Euler, 1/60 s' at screen 0.5,0.97 center noenhanced\nset tics out nomirror\nset "
            "key bottom "
            "right samplen 2 font ',9' opaque\n"
         << map_panel(pairs[0], 65) << "unset label 1\n"
         << map_panel(pairs[1], 560) << "unset key\nset grid lc rgb '#e8e8e8'\n"
         << distance_panel(pairs[0], 65) << distance_panel(pairs[1], 560) << "unset multiplot\n";
  if (auto done = output.draw(script.str(), "document-hoffmann-2002", static_cast<int>(kWidth),
                              static_cast<int>(kHeight));
      !done)
    return done;
  Table table({"forces", "motion", "t", "x", "y", "z", "vx", "vy", "energy"});
  for (const Pair& pair : pairs) {
    for (const auto& [motion, path] :
         {std::pair{"as_played", &pair.played}, std::pair{"exact", &pair.exact}}) {
      for (const PathPoint& q : *path)
        table.add({pair.name, std::string(motion), q.t, q.position.x, q.position.y, q.z, q.velocity.x,
                   q.velocity.y, q.energy});
    }
  }
  return output.write(table, "document-hoffmann-2002");
}

}  // namespace woodlouse::lab
