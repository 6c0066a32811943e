// 2.2: trajectories in a parabolic pot and in a wavy pot.
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "bench/lab/figures/figures.h"
#include "bench/lab/figures/plotting.h"

namespace woodlouse::lab {
namespace {

/// Ours: the text's are lost. Off the axes' symmetry, and slow enough to stay within the pot.
constexpr core::Vec2 kStart{0.8, 0.0};
constexpr core::Vec2 kVelocity{0.0, 1.5};
/// On a function its error is 1e-11 m by then (docs/physics.md), which no picture shows.
constexpr PathMethod kExact{Equations::kSurface, Integrator::kDormandPrince5, 4};

struct Pot {
  terrain::FunctionName function;
  std::string name, title;
};
struct Case {
  bool drag, friction;
  std::string name, title;
};

const std::array<Pot, 2> kPots = {{{terrain::FunctionName::kParabolicPot, "parabolic", "Parabolic pot"},
                                   {terrain::FunctionName::kWavyPot, "wavy", "Wavy pot"}}};
const std::array<Case, 4> kCases = {{{false, false, "none", "neither drag nor friction"},
                                     {true, false, "drag", "viscous drag, 0.2 1/s"},
                                     {false, true, "friction", "Coulomb friction, 0.05"},
                                     {true, true, "both", "drag and friction"}}};

constexpr double kWidth = 800, kHeight = 840;

std::string panel(const Case& shown, const std::vector<PathPoint>& path, std::size_t index) {
  constexpr double kSide = 320;
  const double left = index % 2 == 0 ? 65 : 465;
  const double bottom = index < 2 ? 458 : 55;
  std::ostringstream script;
  script << place(left, bottom, kSide, kSide, kWidth, kHeight) << data_block("$path", plan_of(path))
         << data_block("$start", {{path.front().position.x, path.front().position.y}})
         << data_block("$end", {{path.back().position.x, path.back().position.y}}) << "set title '"
         << shown.title << "' noenhanced offset 0,-0.6\n"
         << "plot $lines using 1:2 with lines lc rgb '#c8c8c8' lw 0.7 notitle, $path using 1:2 with lines "
            "lc rgb '#107030' lw 1.2 notitle, $start using 1:2 with points pt 7 ps 0.9 lc rgb '#1a50b0' "
            "title 'start', $end using 1:2 with points pt 5 ps 0.8 lc rgb '#c02020' title 'end'\n";
  return script.str();
}

std::string picture(const Pot& pot, const document::AnySurface& surface,
                    const std::array<std::vector<PathPoint>, 4>& paths) {
  std::ostringstream script;
  script << height_lines("$lines", surface, 12) << "set multiplot\nset label 1 '" << pot.title
         << ": equations as printed, False Euler, steps of 1/" << kFrameRate << " s, " << paths[0].back().t
         << " s' at screen 0.5,0.975 center\n"
         << "set xrange [-1:1]\nset yrange [-1:1]\nset xtics 0.5\nset ytics 0.5\nset tics out nomirror\n"
         << "set xlabel 'x [m]' offset 0,0.6\nset ylabel 'y [m]' offset 1.5,0\n"
         << "set key bottom right samplen 1 font ',9' opaque\n";
  for (std::size_t i = 0; i < kCases.size(); ++i) {
    script << panel(kCases[i], paths[i], i) << "unset label 1\nunset key\n";
  }
  script << "unset multiplot\n";
  return script.str();
}

void add_rows(Table& table, const Pot& pot, const Case& shown, const std::string& how,
              const std::vector<PathPoint>& path) {
  for (const PathPoint& p : path)
    table.add({pot.name, shown.name, how, p.t, p.position.x, p.position.y, p.z, p.velocity.x, p.velocity.y,
               p.energy});
}

/// Where the energy is furthest from the start's, of it.
double energy_error(const std::vector<PathPoint>& path) {
  double worst = 0.0;
  for (const PathPoint& p : path) worst = std::fmax(worst, std::fabs(p.energy / path.front().energy - 1.0));
  return worst;
}

std::string energy_panel(const Pot& pot, const std::vector<PathPoint>& printed,
                         const std::vector<PathPoint>& exact) {
  const auto share = [&](const PathPoint& p) { return p.energy / exact.front().energy; };
  std::ostringstream script;
  script << data_block("$printed", over_time(printed, share)) << data_block("$exact", over_time(exact, share))
         << "set title '" << pot.title << "'\n"
         << "plot $exact using 1:2 with lines lc rgb '#1a50b0' lw 1.5 title 'exact equations', $printed "
            "using 1:2 with lines lc rgb '#107030' lw 1.2 title 'as printed'\n";
  return script.str();
}

}  // namespace

core::Expected<void> draw_pots(const Output& output, Findings& findings) {
  const Journey journey{kStart, kVelocity, kFrameRate, output.quick ? 2.0 : 10.0};
  Table table({"pot", "forces", "equations", "t", "x", "y", "z", "vx", "vy", "energy"});
  std::string energies;
  for (const Pot& pot : kPots) {
    const document::AnySurface surface = terrain::FunctionSurface(pot.function, 1.0);
    std::array<std::vector<PathPoint>, 4> paths;
    for (std::size_t i = 0; i < kCases.size(); ++i) {
      const state::Parameters p = constants_of_integ(kCases[i].drag, kCases[i].friction);
      auto printed = path_over(surface, kAsPrinted, p, journey);
      if (!printed) return tl::unexpected(printed.error());
      const auto exact = path_over(surface, kExact, p, journey);
      if (!exact) return tl::unexpected(exact.error());
      paths[i] = std::move(*printed);
      add_rows(table, pot, kCases[i], "as_printed", paths[i]);
      add_rows(table, pot, kCases[i], "surface", *exact);
      if (i != 0) continue;
      const std::string where = pot.title + ", no dissipation: energy off by at most, ";
      findings.note("2.2", where + "as printed", 100.0 * energy_error(paths[i]), "%");
      findings.note("2.2", where + "exact equations", 100.0 * energy_error(*exact), "%");
      energies += energy_panel(pot, paths[i], *exact);
    }
    if (auto done = output.draw(picture(pot, surface, paths), "document-2.2-" + pot.name,
                                static_cast<int>(kWidth), static_cast<int>(kHeight));
        !done)
      return done;
  }
  const std::string script =
      "set multiplot layout 1,2\nset grid lc rgb '#e0e0e0'\nset yrange [0.8:1.1]\nset ytics 0.05\nset xlabel "
      "'t [s]'\n"
      "set ylabel 'energy / energy at the start'\nset key top left\n" +
      energies + "unset multiplot\n";
  if (auto done = output.draw(script, "document-2.2-energy", 900, 380); !done) return done;
  return output.write(table, "document-2.2");
}

}  // namespace woodlouse::lab
