#include "shared/document/surface_catalogue.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

namespace woodlouse::document {
namespace {

std::size_t min_knots(Interpolation interpolation) {
  switch (interpolation) {
    case Interpolation::kNatural:
      return 2;
    case Interpolation::kNaturalDocument:
      return Spline::kMinKnots;
    case Interpolation::kBiquadratic:
    case Interpolation::kBlended:
    case Interpolation::kBlendedDocument:
    case Interpolation::kBlendedDifferenced:
    case Interpolation::kGauss:
      return 3;
    case Interpolation::kNotAKnot:
    case Interpolation::kPeriodic:
    case Interpolation::kBSpline:
      return 4;
  }
  assert(false);
  return 0;
}

/// One NaN knot would reach the whole surface.
bool is_global(Interpolation interpolation) {
  return interpolation == Interpolation::kNotAKnot || interpolation == Interpolation::kNatural ||
         interpolation == Interpolation::kPeriodic || interpolation == Interpolation::kNaturalDocument;
}

std::optional<core::Error> misfit(Interpolation interpolation, const terrain::HeightGrid& grid) {
  const std::string where(to_text(interpolation));
  const std::size_t least = min_knots(interpolation);
  if (grid.columns < least || grid.rows < least) {
    return core::Error{where, "needs " + std::to_string(least) + " knots each way", "take a finer grid"};
  }
  if (interpolation == Interpolation::kNaturalDocument &&
      std::max(grid.columns, grid.rows) > Spline::kMaxKnots) {
    return core::Error{where, "takes at most " + std::to_string(Spline::kMaxKnots) + " knots each way",
                       "natural is the same surface without that limit"};
  }
  if (is_global(interpolation)) {
    const auto hole =
        std::find_if(grid.heights.begin(), grid.heights.end(), [](double z) { return !std::isfinite(z); });
    if (hole != grid.heights.end()) {
      const std::size_t k = static_cast<std::size_t>(hole - grid.heights.begin());
      return core::Error{where,
                         "knot (" + std::to_string(k % grid.columns) + ", " +
                             std::to_string(k / grid.columns) + ") has no height",
                         "bspline takes grids with holes"};
    }
  }
  if (interpolation == Interpolation::kPeriodic) {
    const terrain::SeamMismatch seam = terrain::seam_mismatch(grid);
    const auto [low, high] = std::minmax_element(grid.heights.begin(), grid.heights.end());
    if (std::fmax(seam.x, seam.y) > 1e-9 * (*high - *low)) {
      return core::Error{
          where, "the last column or row differs from the first by more than 1e-9 of the heights' range",
          "a wrapping grid holds its seam twice"};
    }
  }
  return std::nullopt;
}

}  // namespace

std::string_view to_text(Interpolation interpolation) {
  switch (interpolation) {
    case Interpolation::kNotAKnot:
      return "not_a_knot";
    case Interpolation::kNatural:
      return "natural";
    case Interpolation::kPeriodic:
      return "periodic";
    case Interpolation::kNaturalDocument:
      return "natural_document";
    case Interpolation::kBiquadratic:
      return "biquadratic";
    case Interpolation::kBlended:
      return "blended";
    case Interpolation::kBlendedDocument:
      return "blended_document";
    case Interpolation::kBlendedDifferenced:
      return "blended_differenced";
    case Interpolation::kGauss:
      return "gauss";
    case Interpolation::kBSpline:
      return "bspline";
  }
  assert(false);
  return {};
}

std::optional<Interpolation> interpolation_from_text(std::string_view text) {
  for (const Interpolation interpolation : kInterpolations) {
    if (to_text(interpolation) == text) return interpolation;
  }
  return std::nullopt;
}

core::Expected<AnySurface> interpolate(Interpolation interpolation, const terrain::HeightGrid& grid) {
  if (auto error = misfit(interpolation, grid)) return tl::unexpected(std::move(*error));
  switch (interpolation) {
    case Interpolation::kNotAKnot:
      return AnySurface(terrain::BicubicSpline(grid));
    case Interpolation::kNatural:
      return AnySurface(terrain::BicubicSpline(grid, terrain::SplineEnds::kNatural));
    case Interpolation::kPeriodic:
      return AnySurface(
          terrain::WrappedSurface(terrain::BicubicSpline(grid, terrain::SplineEnds::kPeriodic)));
    case Interpolation::kNaturalDocument:
      return AnySurface(Spline(grid));
    case Interpolation::kBiquadratic:
      return AnySurface(Biquadratic(grid));
    case Interpolation::kBlended:
      return AnySurface(Blended(grid));
    case Interpolation::kBlendedDocument:
      return AnySurface(BlendedDocument(grid));
    case Interpolation::kBlendedDifferenced:
      return AnySurface(BlendedDifferenced(grid));
    case Interpolation::kGauss:
      return AnySurface(GaussGradient(grid));
    case Interpolation::kBSpline:
      return AnySurface(terrain::TiledBSpline(grid));
  }
  assert(false);
  return core::fail("surface", "is unknown");
}

bool has_hessian(const AnySurface& surface) {
  return std::visit([]<typename S>(const S&) { return terrain::kHasHessian<S>; }, surface);
}

}  // namespace woodlouse::document
