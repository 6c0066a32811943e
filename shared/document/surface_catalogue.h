// Every interpolation by name, the document's and ours: the lab's --surface. A step of the server needs none
// of it; it is compiled over the grounds of terrain.h.
//
//     not_a_knot natural periodic natural_document biquadratic blended blended_document blended_differenced
//     gauss bspline
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <variant>

#include "shared/core/error.h"
#include "shared/document/biquadratic.h"
#include "shared/document/blended_biquadratic.h"
#include "shared/document/gauss_gradient.h"
#include "shared/document/spline.h"
#include "shared/terrain/bicubic_spline.h"
#include "shared/terrain/function_surface.h"
#include "shared/terrain/height_grid.h"
#include "shared/terrain/tiled_bspline.h"
#include "shared/terrain/wrapped_surface.h"

namespace woodlouse::document {

enum class Interpolation {
  kNotAKnot,
  kNatural,
  kPeriodic,
  kNaturalDocument,
  kBiquadratic,
  kBlended,
  kBlendedDocument,
  kBlendedDifferenced,
  kGauss,
  kBSpline,
};

inline constexpr std::array kInterpolations = {
    Interpolation::kNotAKnot,        Interpolation::kNatural,
    Interpolation::kPeriodic,        Interpolation::kNaturalDocument,
    Interpolation::kBiquadratic,     Interpolation::kBlended,
    Interpolation::kBlendedDocument, Interpolation::kBlendedDifferenced,
    Interpolation::kGauss,           Interpolation::kBSpline};

std::string_view to_text(Interpolation interpolation);
std::optional<Interpolation> interpolation_from_text(std::string_view text);

/// Any surface; reached by one visit per batch of points.
using AnySurface = std::variant<terrain::FunctionSurface, terrain::BicubicSpline,
                                terrain::WrappedSurface<terrain::BicubicSpline>, Spline, Biquadratic, Blended,
                                BlendedDocument, BlendedDifferenced, GaussGradient, terrain::TiledBSpline>;

/// The interpolation of a grid. Errors, all of the grid: too few or too many knots, heights that are not
/// finite where the interpolation is global, first and last knots that differ where it is periodic.
core::Expected<AnySurface> interpolate(Interpolation interpolation, const terrain::HeightGrid& grid);

/// Whether its samples carry a Hessian, asked at run time.
bool has_hessian(const AnySurface& surface);

}  // namespace woodlouse::document
