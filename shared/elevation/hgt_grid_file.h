// SRTM tiles (.hgt): a degree of the world, 1201 x 1201 (3 arc seconds) or 3601 x 3601 knots (1 arc second)
// of big-endian 16-bit metres, the north first; -32768: no data. Where it lies only its name says:
// N47E011.hgt has its south-western knot at 47 N, 11 E.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "shared/core/error.h"
#include "shared/core/input_file.h"
#include "shared/core/vec2.h"
#include "shared/terrain/height_source.h"

namespace woodlouse::elevation {

/// The south-western knot [degrees: longitude, latitude] that a file's name says, as S37E174.hgt or
/// n07w003_dem.hgt do; nothing: it says none.
std::optional<core::Vec2> corner_of_name(std::string_view name);

/// An open tile, in degrees: immutable, any thread may read. Heights that can't be read any more count as
/// without data, see read_failures().
class HgtGrid final : public terrain::HeightSource {
 public:
  /// The tile in an open file. `corner`: in place of what the name says. Errors: a size that is neither of
  /// the two, a name without a corner where none is given.
  static core::Expected<std::shared_ptr<const HgtGrid>> open(core::InputFile file,
                                                             std::optional<core::Vec2> corner);
  HgtGrid(const HgtGrid&) = delete;
  HgtGrid& operator=(const HgtGrid&) = delete;

  [[nodiscard]] terrain::GridFrame frame() const override { return frame_; }
  void read(std::size_t column, std::size_t row, std::span<double> out) const override;
  [[nodiscard]] std::uint64_t read_failures() const override {
    return read_failures_.load(std::memory_order_relaxed);
  }

 private:
  HgtGrid(const terrain::GridFrame& frame, core::InputFile file) : frame_(frame), file_(std::move(file)) {}

  terrain::GridFrame frame_;
  core::InputFile file_;
  mutable std::atomic<std::uint64_t> read_failures_{0};
};

}  // namespace woodlouse::elevation
