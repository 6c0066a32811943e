// The surface that --surface, --function, --grid and --map name.
#pragma once

#include <cstddef>
#include <string>

#include "shared/core/error.h"
#include "shared/document/surface_catalogue.h"

namespace CLI {
class App;
}

namespace woodlouse::lab {

struct SurfaceOptions {
  std::string surface = "not_a_knot";
  std::string function = "wavy_pot";
  std::size_t grid = 10;
  std::string map;  ///< a map file or an ESRI float grid (.flt); empty: the function
};

enum class MapOption { kOffered, kNotOffered };

void add_surface_options(CLI::App& app, SurfaceOptions& options, MapOption map);
/// Functions and their grids lie on [-1, 1]; maps where they say.
core::Expected<document::AnySurface> make_surface(const SurfaceOptions& options);

}  // namespace woodlouse::lab
