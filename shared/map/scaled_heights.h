// A grid file's heights as a map uses them: lengths and heights times the map's scale, its middle at (0, 0).
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "shared/terrain/height_source.h"

namespace woodlouse::map {

/// Heights beyond +-`highest` [m] count as without data: nobody checks every height of a map that is not read
/// whole.
class ScaledHeights final : public terrain::HeightSource {
 public:
  /// `metres`: the file's frame in metres.
  ScaledHeights(std::shared_ptr<const terrain::HeightSource> file, const terrain::GridFrame& metres,
                double scale, double highest)
      : file_(std::move(file)), frame_(metres), scale_(scale), highest_(highest) {
    frame_.dx *= scale;
    frame_.dy *= scale;
    frame_.x_origin = -0.5 * (static_cast<double>(frame_.columns - 1) * frame_.dx);
    frame_.y_origin = -0.5 * (static_cast<double>(frame_.rows - 1) * frame_.dy);
  }

  [[nodiscard]] terrain::GridFrame frame() const override { return frame_; }
  void read(std::size_t column, std::size_t row, std::span<double> out) const override {
    file_->read(column, row, out);
    for (double& height : out) {
      height *= scale_;
      if (!(std::fabs(height) <= highest_)) height = std::numeric_limits<double>::quiet_NaN();
    }
  }
  [[nodiscard]] std::uint64_t read_failures() const override { return file_->read_failures(); }
  /// As the file has it: not scaled.
  [[nodiscard]] std::optional<double> undeclared_mark() const override { return file_->undeclared_mark(); }

 private:
  std::shared_ptr<const terrain::HeightSource> file_;
  terrain::GridFrame frame_;
  double scale_;
  double highest_;
};

}  // namespace woodlouse::map
