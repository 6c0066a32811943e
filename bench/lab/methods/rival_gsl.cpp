#include "bench/lab/methods/rival.h"

#ifdef WOODLOUSE_HAS_GSL
#include <gsl/gsl_spline2d.h>

#include <vector>
#endif

namespace woodlouse::lab {

#ifdef WOODLOUSE_HAS_GSL
namespace {

enum class Calls { kThree, kSix };

struct Free {
  void operator()(gsl_spline2d* p) const { gsl_spline2d_free(p); }
  void operator()(gsl_interp_accel* p) const { gsl_interp_accel_free(p); }
};

class Gsl final : public Rival {
 public:
  Gsl(const terrain::HeightGrid& grid, Calls calls)
      : calls_(calls),
        spline_(gsl_spline2d_alloc(gsl_interp2d_bicubic, grid.columns, grid.rows)),
        x_accelerator_(gsl_interp_accel_alloc()),
        y_accelerator_(gsl_interp_accel_alloc()) {
    std::vector<double> x;
    std::vector<double> y;
    for (std::size_t i = 0; i < grid.columns; ++i)
      x.push_back(grid.x_origin + static_cast<double>(i) * grid.dx);
    for (std::size_t j = 0; j < grid.rows; ++j) y.push_back(grid.y_origin + static_cast<double>(j) * grid.dy);
    gsl_spline2d_init(spline_.get(), x.data(), y.data(), grid.heights.data(), grid.columns, grid.rows);
  }

  [[nodiscard]] double sum(std::span<const core::Vec2> points) const override {
    const gsl_spline2d* s = spline_.get();
    gsl_interp_accel* i = x_accelerator_.get();
    gsl_interp_accel* j = y_accelerator_.get();
    double total = 0.0;
    for (const core::Vec2 p : points) {
      total += gsl_spline2d_eval(s, p.x, p.y, i, j) + gsl_spline2d_eval_deriv_x(s, p.x, p.y, i, j) +
               gsl_spline2d_eval_deriv_y(s, p.x, p.y, i, j);
      if (calls_ == Calls::kThree) continue;
      total += gsl_spline2d_eval_deriv_xx(s, p.x, p.y, i, j) + gsl_spline2d_eval_deriv_xy(s, p.x, p.y, i, j) +
               gsl_spline2d_eval_deriv_yy(s, p.x, p.y, i, j);
    }
    return total;
  }

 private:
  Calls calls_;
  std::unique_ptr<gsl_spline2d, Free> spline_;
  std::unique_ptr<gsl_interp_accel, Free> x_accelerator_;
  std::unique_ptr<gsl_interp_accel, Free> y_accelerator_;
};

}  // namespace

std::unique_ptr<Rival> gsl_six_calls(const terrain::HeightGrid& grid) {
  return std::make_unique<Gsl>(grid, Calls::kSix);
}
std::unique_ptr<Rival> gsl_three_calls(const terrain::HeightGrid& grid) {
  return std::make_unique<Gsl>(grid, Calls::kThree);
}

#else

std::unique_ptr<Rival> gsl_six_calls(const terrain::HeightGrid&) { return nullptr; }
std::unique_ptr<Rival> gsl_three_calls(const terrain::HeightGrid&) { return nullptr; }

#endif

}  // namespace woodlouse::lab
