// A surface seen from a distance, drawn pixel by pixel with a z-buffer: what is behind the terrain is hidden
// (chapter 3.5), and every pixel is lit by the normal that the surface itself gives there (chapter 4.2).
//
// Parallel projection. Pixels are shown as they are or as the mean of several finer ones; row 0 is the
// lowest.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "shared/terrain/height_grid.h"
#include "shared/terrain/surface.h"

namespace woodlouse::lab {

struct Colour {
  double red = 1.0, green = 1.0, blue = 1.0;  ///< 0 .. 1
};

struct Place {
  double x = 0.0, y = 0.0, z = 0.0;
};

/// From where it is seen.
struct View {
  double azimuth;           ///< of the viewer, counter-clockwise from +x [degrees]
  double elevation;         ///< of the viewer above the map plane [degrees]
  Place centre;             ///< what stands in the picture's middle [m]
  double metres_across;     ///< the picture's width [m]
  double heights_by = 1.0;  ///< z is drawn so many times as high; light and hiding follow
  /// > 0: instead of shades, stripes of equal light, each as wide as the normal turns by so much [degrees]. A
  /// crease breaks them.
  double stripes = 0.0;
};

using Heights = std::function<terrain::SlopeSample(double x, double y)>;

class Scene {
 public:
  /// `finer`: so many rows and columns of samples a pixel, >= 1.
  Scene(std::size_t width, std::size_t height, std::size_t finer, const View& view);

  /// The heights over `domain`, as a mesh of `mesh` cells a side, each pixel lit by the gradient that
  /// `normals` gives there. Its underside is dull.
  void add_terrain(const terrain::Rectangle& domain, std::size_t mesh, const Heights& heights,
                   const Heights& normals, Colour colour);

  enum class Depth { kTested, kIgnored };
  /// A line through `points`; kTested: hidden behind what was added before. `width` [pixels].
  void add_line(const std::vector<Place>& points, Colour colour, double width, Depth depth);

  /// Whether what was added stands before a place on it.
  [[nodiscard]] bool hides(const Place& place) const;

  /// A gnuplot script that plots it, a unit of the axes a pixel. Its bytes stand in the script: as a block of
  /// text they cost gnuplot seconds.
  [[nodiscard]] std::string plot() const;

 private:
  struct Seen {
    double column, row;  ///< [fine pixels]
    double near;         ///< towards the viewer [m]
  };
  struct Corner {
    Seen seen;
    double x, y;
  };
  [[nodiscard]] Seen seen(const Place& place) const;
  void fill(const Corner& a, const Corner& b, const Corner& c, const Heights& normals, Colour colour);
  /// The fine pixel beside the one where `at` is; nothing outside of the picture.
  [[nodiscard]] std::optional<std::size_t> pixel_at(const Seen& at, long right, long up) const;
  [[nodiscard]] bool is_behind(const Seen& at, std::size_t pixel) const;
  void dot(const Seen& at, double radius, Colour colour, Depth depth);
  [[nodiscard]] Colour lit(const terrain::SlopeSample& s, Colour colour) const;

  View view_;
  std::size_t finer_, columns_, rows_;
  Place right_, up_, towards_;  ///< the viewer's axes
  Place light_;                 ///< where it comes from
  double fine_pixels_a_metre_;
  std::vector<Colour> colours_;
  std::vector<double> near_;
};

/// What the terrain's flat facets between the knots are: heights and gradients of two triangles a cell.
Heights facets_of(const terrain::HeightGrid& grid);

}  // namespace woodlouse::lab
