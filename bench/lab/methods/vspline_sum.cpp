#include "bench/lab/methods/vspline_sum.h"

#include <vspline/vspline.h>

#include <cassert>
#include <vector>

namespace woodlouse::lab {
namespace {

using Evaluator = vspline::evaluator<vigra::TinyVector<double, 2>, double>;
using Spline = vspline::bspline<double, 2>;

class Sum final : public VsplineSum {
 public:
  Sum(std::size_t columns, std::size_t rows, const double* heights)
      : spline_(Spline::shape_type(static_cast<long>(columns), static_cast<long>(rows)), 3,
                Spline::bcv_type(vspline::NATURAL), 0.0) {
    for (std::size_t j = 0; j < rows; ++j)
      for (std::size_t i = 0; i < columns; ++i)
        spline_.core(static_cast<long>(i), static_cast<long>(j)) = heights[j * columns + i];
    spline_.prefilter();
    for (int along_x = 0; along_x <= 2; ++along_x)
      for (int along_y = 0; along_x + along_y <= 2; ++along_y) {
        Evaluator::derivative_spec_type derivative;
        derivative[0] = along_x;
        derivative[1] = along_y;
        evaluators_.emplace_back(spline_, derivative);
      }
  }

  double sum(const double* points, std::size_t count) const override {
    constexpr std::size_t kWidth = Evaluator::vsize;
    assert(count % kWidth == 0);
    Evaluator::out_v whole(0.0);
    for (std::size_t begin = 0; begin < count; begin += kWidth) {
      Evaluator::in_v places;
      for (std::size_t lane = 0; lane < kWidth; ++lane) {
        places[0][lane] = points[2 * (begin + lane)];
        places[1][lane] = points[2 * (begin + lane) + 1];
      }
      for (const Evaluator& evaluator : evaluators_) {
        Evaluator::out_v values;
        evaluator.eval(places, values);
        whole += values;
      }
    }
    double total = 0.0;
    for (std::size_t lane = 0; lane < kWidth; ++lane) total += whole[lane];
    return total;
  }

 private:
  Spline spline_;
  std::vector<Evaluator> evaluators_;
};

}  // namespace

std::unique_ptr<VsplineSum> make_vspline_sum(std::size_t columns, std::size_t rows, const double* heights) {
  return std::make_unique<Sum>(columns, rows, heights);
}

}  // namespace woodlouse::lab
