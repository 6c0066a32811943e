#include "bench/lab/methods/rival.h"

#ifdef WOODLOUSE_HAS_VSPLINE
#include <vector>

#include "bench/lab/methods/vspline_sum.h"
#include "shared/physics/batch.h"
#endif

namespace woodlouse::lab {

#ifdef WOODLOUSE_HAS_VSPLINE
namespace {

class Vspline final : public Rival {
 public:
  explicit Vspline(const terrain::HeightGrid& grid)
      : grid_(grid), sum_(make_vspline_sum(grid.columns, grid.rows, grid.heights.data())) {}

  [[nodiscard]] double sum(std::span<const core::Vec2> points) const override {
    places_.clear();
    for (const core::Vec2 p : points) {
      places_.push_back((p.x - grid_.x_origin) / grid_.dx);
      places_.push_back((p.y - grid_.y_origin) / grid_.dy);
    }
    return sum_->sum(places_.data(), points.size());
  }

 private:
  const terrain::HeightGrid& grid_;
  std::unique_ptr<const VsplineSum> sum_;
  mutable std::vector<double> places_;
};

}  // namespace

std::unique_ptr<Rival> vspline_six_evaluators(const terrain::HeightGrid& grid) {
  if (!physics::is_available(physics::InstructionSet::kAvx2)) return nullptr;  // it is compiled for it
  return std::make_unique<Vspline>(grid);
}

#else

std::unique_ptr<Rival> vspline_six_evaluators(const terrain::HeightGrid&) { return nullptr; }

#endif

}  // namespace woodlouse::lab
