#include "bench/lab/methods/rival.h"

#ifdef WOODLOUSE_HAS_ALGLIB
#include <libalglib/interpolation.h>
#endif

namespace woodlouse::lab {

#ifdef WOODLOUSE_HAS_ALGLIB
namespace {

class Alglib final : public Rival {
 public:
  explicit Alglib(const terrain::HeightGrid& grid) {
    alglib::real_1d_array x;
    alglib::real_1d_array y;
    alglib::real_1d_array z;
    const auto columns = static_cast<alglib::ae_int_t>(grid.columns);
    const auto rows = static_cast<alglib::ae_int_t>(grid.rows);
    x.setlength(columns);
    y.setlength(rows);
    for (alglib::ae_int_t i = 0; i < columns; ++i) x[i] = grid.x_origin + static_cast<double>(i) * grid.dx;
    for (alglib::ae_int_t j = 0; j < rows; ++j) y[j] = grid.y_origin + static_cast<double>(j) * grid.dy;
    z.setcontent(columns * rows, grid.heights.data());
    alglib::spline2dbuildbicubicv(x, columns, y, rows, z, 1, spline_);
  }

  [[nodiscard]] double sum(std::span<const core::Vec2> points) const override {
    double total = 0.0;
    for (const core::Vec2 p : points) {
      double z = 0.0;
      double zx = 0.0;
      double zy = 0.0;
      double zxy = 0.0;
      alglib::spline2ddiff(spline_, p.x, p.y, z, zx, zy, zxy);
      total += z + zx + zy;
    }
    return total;
  }

 private:
  alglib::spline2dinterpolant spline_;
};

}  // namespace

std::unique_ptr<Rival> alglib_differentiation(const terrain::HeightGrid& grid) {
  return std::make_unique<Alglib>(grid);
}

#else

std::unique_ptr<Rival> alglib_differentiation(const terrain::HeightGrid&) { return nullptr; }

#endif

}  // namespace woodlouse::lab
