// 3.5: a trajectory on interpolated terrain. Left the knots alone, flat between, the path drawn over all;
// right the biquadratic surface that the louse runs on, the path hidden where the terrain stands before it.
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bench/lab/figures/figures.h"
#include "bench/lab/figures/path.h"
#include "bench/lab/figures/plotting.h"
#include "bench/lab/figures/scene.h"
#include "bench/lab/problems/motion.h"

namespace woodlouse::lab {
namespace {

constexpr std::size_t kGrid = 10;  // "e.g. grid=10" (3.6.1)
constexpr double kWidth = 1000, kHeight = 400;
constexpr std::size_t kPanelWidth = 480, kPanelHeight = 340;
constexpr View kView{-72.0, 33.0, {0.0, 0.0, 0.8}, 2.7, 1.0};
constexpr Colour kGround{0.95, 0.88, 0.74}, kGreen{0.0, 0.55, 0.1}, kKnotLines{0.45, 0.42, 0.36};

/// The lines of knots, over the ground.
void add_knot_lines(Scene& scene, const terrain::HeightGrid& grid, const Heights& heights) {
  constexpr std::size_t kPieces = 160;
  const terrain::Rectangle d = grid.domain();
  for (std::size_t k = 0; k < grid.columns; ++k) {
    std::vector<Place> along_x, along_y;
    for (std::size_t i = 0; i <= kPieces; ++i) {
      const double t = static_cast<double>(i) / kPieces;
      const double x = d.x_min + t * (d.x_max - d.x_min), y = d.y_min + grid.dy * static_cast<double>(k);
      along_x.push_back({x, y, heights(x, y).z});
      along_y.push_back({y, x, heights(y, x).z});  // the grid is a square about the origin
    }
    for (const auto& line : {along_x, along_y}) scene.add_line(line, kKnotLines, 0.6, Scene::Depth::kTested);
  }
}

std::vector<Place> in_space(const std::vector<PathPoint>& path) {
  std::vector<Place> places;
  for (const PathPoint& p : path) places.push_back({p.position.x, p.position.y, p.z});
  return places;
}

std::string panel(const Scene& scene, const std::string& title, double left) {
  std::ostringstream script;
  script << place(left, 15, kPanelWidth, kPanelHeight, kWidth, kHeight) << "set title '" << title << "'\n"
         << scene.plot();
  return script.str();
}

}  // namespace

core::Expected<void> draw_interpolated_terrain(const Output& output, Findings& findings) {
  const terrain::HeightGrid grid = terrain::sample_function(terrain::FunctionName::kWavyPot, 1.0, kGrid);
  const auto surface = document::interpolate(document::Interpolation::kBiquadratic, grid);
  if (!surface) return tl::unexpected(surface.error());
  const Journey journey{{0.9, 0.1}, {-0.6, 1.3}, kFrameRate, output.quick ? 2.0 : 12.0};
  const auto path = path_over(*surface, kAsPrinted, constants_of_integ(true, false), journey);
  if (!path) return tl::unexpected(path.error());

  const std::size_t finer = output.quick ? 1 : 3;
  const Heights facets = facets_of(grid);
  const Heights interpolated = [&](double x, double y) { return sample_of(*surface, {x, y}); };
  Scene knots(kPanelWidth, kPanelHeight, finer, kView), hiding(kPanelWidth, kPanelHeight, finer, kView);
  knots.add_terrain(grid.domain(), 2 * kGrid, facets, facets, kGround);
  knots.add_line(in_space(*path), kGreen, 1.5, Scene::Depth::kIgnored);
  hiding.add_terrain(grid.domain(), output.quick ? 80 : 240, interpolated, interpolated, kGround);
  add_knot_lines(hiding, grid, interpolated);
  hiding.add_line(in_space(*path), kGreen, 1.5, Scene::Depth::kTested);

  const std::string script = "set multiplot\nunset border\nunset tics\n" +
                             panel(knots, "The knots, not interpolated; the path drawn over all", 10) +
                             panel(hiding, "Biquadratic interpolation; the path z-buffered", 510) +
                             "unset multiplot\n";
  if (auto done =
          output.draw(script, "document-3.5-terrain", static_cast<int>(kWidth), static_cast<int>(kHeight));
      !done)
    return done;
  Table table({"t", "x", "y", "z", "vx", "vy", "energy", "hidden"});
  double hidden = 0.0;
  for (const PathPoint& p : *path) {
    const double is_hidden = hiding.hides({p.position.x, p.position.y, p.z}) ? 1.0 : 0.0;
    hidden += is_hidden;
    table.add({p.t, p.position.x, p.position.y, p.z, p.velocity.x, p.velocity.y, p.energy, is_hidden});
  }
  findings.note("3.5", "of the path, behind the terrain", 100.0 * hidden / static_cast<double>(path->size()),
                "%");
  return output.write(table, "document-3.5");
}

}  // namespace woodlouse::lab
