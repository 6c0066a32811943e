#include "shared/map/edges_reader.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "shared/core/joined.h"
#include "shared/json/text.h"
#include "shared/terrain/bicubic_spline.h"

namespace woodlouse::map {
namespace {

constexpr double kSeamTolerance = 1e-9;

void check_heights(const json::Value& value, const terrain::HeightGrid& grid, json::Problems& problems) {
  const auto [low, high] = std::minmax_element(grid.heights.begin(), grid.heights.end());
  const double most = kSeamTolerance * (*high - *low);
  const terrain::SeamMismatch mismatch = terrain::seam_mismatch(grid);
  const auto tell = [&](double apart, std::string_view first, std::string_view last, std::string_view hint) {
    if (apart <= most) return;
    problems.add(value,
                 core::joined({"the heights of the ", first, " and the ", last, " differ by up to ",
                               json::double_text(apart), " m: there would be a cliff at the seam"}),
                 std::string(hint));
  };
  tell(mismatch.x, "western", "eastern rim", "make the last column the first again");
  tell(mismatch.y, "southern", "northern rim", "make the last row the first again");
}

double apart(const terrain::SurfaceSample& a, const terrain::SurfaceSample& b) {
  return std::max({std::abs(a.z - b.z), std::abs(a.zx - b.zx), std::abs(a.zy - b.zy), std::abs(a.zxx - b.zxx),
                   std::abs(a.zxy - b.zxy), std::abs(a.zyy - b.zyy)});
}

void check_function(const json::Value& value, const FunctionTerrain& terrain, json::Problems& problems) {
  const terrain::FunctionSurface unit(terrain.function, 1.0);
  double worst = 0.0;
  for (std::size_t k = 0; k <= 2 * terrain.grid; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(terrain.grid) - 1.0;
    worst = std::max({worst, apart(unit.sample(-1.0, t), unit.sample(1.0, t)),
                      apart(unit.sample(t, -1.0), unit.sample(t, 1.0))});
  }
  if (worst <= kSeamTolerance) return;
  problems.add(
      value,
      core::joined({"the function ", terrain::to_text(terrain.function),
                    " does not repeat: height, slope or curvature jump from one rim to the opposite one"}),
      "take the function waves, or heights whose last column and row are the first again");
}

}  // namespace

state::Edges read_edges(const json::Value& value, const MapDefinition& definition, json::Problems& problems) {
  const auto edges = value.is(json::Kind::kString) ? state::edges_from_text(value.text()) : std::nullopt;
  if (!edges) {
    problems.add(value, "is none of its choices", "walls, wrap or open");
    return state::Edges::kWalls;
  }
  if (*edges != state::Edges::kWrap) return *edges;
  if (definition.surface == SurfaceKind::kNaturalSpline) {
    problems.add(value, "a natural spline has ends, and edges that wrap have none",
                 "take the surface spline");
  }
  if (is_of_document(definition.surface)) {
    problems.add(value, "the paper's surfaces have rims, and edges that wrap have none",
                 "take the surface spline");
  }
  if (definition.physics.central_gravity != 0.0) {
    problems.add(value, "central gravity jumps where the edges wrap",
                 "leave central_gravity out, or take walls");
  }
  if (const auto* grid = std::get_if<terrain::HeightGrid>(&definition.terrain)) {
    check_heights(value, *grid, problems);
  } else if (const auto* function = std::get_if<FunctionTerrain>(&definition.terrain)) {
    check_function(value, *function, problems);
  } else {
    problems.add(value, "a terrain that is read tile by tile has no seams that could be checked",
                 "take walls");
  }
  return *edges;
}

}  // namespace woodlouse::map
