// 4.2: the biquadratic surface without and with blending, lit by the normals that each interpolation gives,
// and the normal vector tested where the interpolation changes from one knot's paraboloid to the next one's.
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bench/lab/figures/figures.h"
#include "bench/lab/figures/plotting.h"
#include "bench/lab/figures/scene.h"
#include "bench/lab/problems/motion.h"

namespace woodlouse::lab {
namespace {

using document::Interpolation;

constexpr auto kFunction = terrain::FunctionName::kVolcano;  // "a parabolic or conical pot plus a volcano"
constexpr std::size_t kGrid = 10;
constexpr double kWidth = 1000, kHeight = 835;
constexpr std::size_t kPanelWidth = 480, kPanelHeight = 360;
constexpr double kAround = 0.5;  ///< what is shown of the terrain, the volcano [m]
constexpr View kShaded{-60.0, 48.0, {0.0, 0.0, 0.27}, 1.5, 2.0};
constexpr View kStriped{-60.0, 48.0, {0.0, 0.0, 0.27}, 1.5, 2.0, 3.0};
constexpr double kAlong = 0.13;  ///< where the normal is tested [m]
constexpr Colour kGround{0.95, 0.88, 0.74};

struct Shown {
  Interpolation interpolation;
  std::string title, colour;
};
const std::array<Shown, 2> kShown = {{{Interpolation::kBiquadratic, "without blending", "#c02020"},
                                      {Interpolation::kBlendedDocument, "with blending", "#107030"}}};

/// The angle between the normals just before and just beyond a line, the largest met along it [degrees].
/// across: the line is x = `at`, else y = `at`.
double crease(const document::AnySurface& surface, double at, bool across) {
  constexpr double kAside = 1e-9;  // knots are 0.1 apart
  constexpr int kPlaces = 400;
  constexpr double kReach = 0.9;  // beyond, the stencil at the rim is another
  double worst = 0.0;
  for (int i = 0; i <= kPlaces; ++i) {
    const double along = kReach * (2.0 * i / kPlaces - 1.0);
    const auto gradient = [&](double beside) {
      const terrain::SurfaceSample s =
          across ? sample_of(surface, {at + beside, along}) : sample_of(surface, {along, at + beside});
      return core::Vec2{s.zx, s.zy};
    };
    const core::Vec2 a = gradient(-kAside), b = gradient(kAside);
    const core::Vec2 d = b - a;
    const double turn = a.x * b.y - a.y * b.x;  // (-a, 1) x (-b, 1) = (dy, -dx, turn) up to signs
    const double angle = std::atan2(std::sqrt(dot(d, d) + turn * turn), 1.0 + dot(a, b));
    worst = std::fmax(worst, angle * 180.0 / std::numbers::pi);
  }
  return worst;
}

/// A row of the table for each line: those of knots, and those halfway between, where the centre changes.
double add_creases(Table& table, const document::AnySurface& surface, const std::string& name) {
  double worst = 0.0;
  constexpr int kHalfSteps = 2 * (static_cast<int>(kGrid) - 1);
  for (int k = -kHalfSteps + 1; k < kHalfSteps; ++k) {
    const double at = 0.5 * k / static_cast<double>(kGrid);
    for (const bool across : {true, false}) {
      const double angle = crease(surface, at, across);
      worst = std::fmax(worst, angle);
      table.add(
          {name, std::string(k % 2 == 0 ? "knots" : "halfway"), std::string(across ? "x" : "y"), at, angle});
    }
  }
  return worst;
}

std::string image(const document::AnySurface& surface, const View& view, const std::string& title,
                  double left, double bottom, bool quick) {
  Scene scene(kPanelWidth, kPanelHeight, quick ? 1 : 3, view);
  const Heights heights = [&](double x, double y) { return sample_of(surface, {x, y}); };
  scene.add_terrain({-kAround, -kAround, kAround, kAround}, quick ? 80 : 240, heights, heights, kGround);
  std::ostringstream script;
  script << place(left, bottom, kPanelWidth, kPanelHeight, kWidth, kHeight) << "set title '" << title << "'\n"
         << scene.plot();
  return script.str();
}

/// zy along y = kAlong: of each interpolation, and of the function. (zx is the one that does not jump across
/// x = const: halfway between two knots either paraboloid has the slope of their chord.)
std::vector<std::vector<double>> slopes(const document::AnySurface& surface, double from, double to) {
  constexpr int kPoints = 600;
  std::vector<std::vector<double>> rows;
  for (int i = 0; i <= kPoints; ++i) {
    const double x = from + (to - from) * i / kPoints;
    rows.push_back({x, sample_of(surface, {x, kAlong}).zy});
  }
  return rows;
}

std::string profile_panel(const std::array<document::AnySurface, 2>& surfaces, double from, double to,
                          const std::string& title) {
  const document::AnySurface function = terrain::FunctionSurface(kFunction, 1.0);
  std::string blocks = data_block("$function", slopes(function, from, to));
  std::ostringstream plots;
  plots << "plot $function using 1:2 with lines lc rgb '#b8b8b8' lw 4 title 'the function'";
  for (std::size_t i = 0; i < kShown.size(); ++i) {
    const std::string name = "$slopes" + std::to_string(i);
    blocks += data_block(name, slopes(surfaces[i], from, to));
    plots << ", " << name << " using 1:2 with lines lc rgb '" << kShown[i].colour << "' lw 1.3 title '"
          << kShown[i].title << '\'';
  }
  std::ostringstream script;
  script << blocks << "set title '" << title << "'\nset xrange [" << from << ':' << to << "]\n"
         << plots.str() << '\n';
  return script.str();
}

std::string profile(const std::array<document::AnySurface, 2>& surfaces) {
  return "set multiplot layout 1,2\nset tics out nomirror\nset xlabel 'x [m], along y = 0.13'\nset ylabel "
         "'slope zy' offset 1,0\nset key top center samplen 2\nset xtics 0.4\n" +
         profile_panel(surfaces, -0.8, 0.8, "Testing the normal vector") +
         "set xtics 0.1\nset grid xtics lt 1 lc rgb '#b0b0b0'\n" +
         profile_panel(surfaces, -0.2, 0.2, "The same, nearer; knots at the grey lines") +
         "unset multiplot\n";
}

}  // namespace

core::Expected<void> draw_blending(const Output& output, Findings& findings) {
  const terrain::HeightGrid grid = terrain::sample_function(kFunction, 1.0, kGrid);
  Table table({"interpolation", "line", "constant", "at", "crease_degrees"});
  std::vector<document::AnySurface> made;
  std::string images;
  for (const Shown& shown : kShown) {
    auto surface = document::interpolate(shown.interpolation, grid);
    if (!surface) return tl::unexpected(surface.error());
    const double worst = add_creases(table, *surface, std::string(to_text(shown.interpolation)));
    findings.note("4.2", "sharpest crease " + shown.title, worst, "degrees");
    const double left = made.empty() ? 10 : 510;
    images += image(*surface, kShaded, "Biquadratic interpolation " + shown.title, left, 425, output.quick) +
              image(*surface, kStriped, "Stripes of equal light, " + shown.title, left, 20, output.quick);
    made.push_back(std::move(*surface));
  }
  const std::string script = "set multiplot\nunset border\nunset tics\n" + images + "unset multiplot\n";
  if (auto done =
          output.draw(script, "document-4.2-blending", static_cast<int>(kWidth), static_cast<int>(kHeight));
      !done)
    return done;
  if (auto done =
          output.draw(profile({std::move(made[0]), std::move(made[1])}), "document-4.2-normals", 960, 420);
      !done)
    return done;
  return output.write(table, "document-4.2");
}

}  // namespace woodlouse::lab
