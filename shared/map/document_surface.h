// Which of the paper's interpolations a map's surface is.
#pragma once

#include <cassert>

#include "shared/document/surface_catalogue.h"
#include "shared/map/map_definition.h"

namespace woodlouse::map {

/// REQUIRES is_of_document(kind).
constexpr document::Interpolation interpolation_of(SurfaceKind kind) {
  assert(is_of_document(kind));
  switch (kind) {
    case SurfaceKind::kBiquadratic:
      return document::Interpolation::kBiquadratic;
    case SurfaceKind::kBlended:
      return document::Interpolation::kBlended;
    case SurfaceKind::kBlendedDocument:
      return document::Interpolation::kBlendedDocument;
    case SurfaceKind::kGauss:
      return document::Interpolation::kGauss;
    default:
      return document::Interpolation::kNaturalDocument;
  }
}

}  // namespace woodlouse::map
