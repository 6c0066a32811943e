// An ESRI float grid (flt_header.h) read from its file.
//
// Rows are read one by one (pread) out of the system's page cache, not through a memory map: a tile touches
// 124 rows, each on pages of its own, and a page fault costs four times such a read (0.13 against 0.55 ms a
// tile, measured). Nor do the pages count as this process's memory then, nor does a file that shrinks under
// us end the process.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "shared/core/error.h"
#include "shared/core/input_file.h"
#include "shared/map/flt_header.h"
#include "shared/terrain/height_source.h"

namespace woodlouse::map {

/// An open grid: immutable, any thread may read. Heights that can't be read any more (the disk fails, the
/// file was cut) count as without data; read_failures() says whether that happened.
class FltGrid final : public terrain::HeightSource {
 public:
  /// `file` is the .flt that the user named; its header is the .hdr beside it. Errors: no such files, a bad
  /// header, a size that isn't 4 nrows ncols.
  static core::Expected<std::shared_ptr<const FltGrid>> open(const std::filesystem::path& file);
  /// The same of a .flt that a map named: both files must lie in `folder` (core/input_file.h).
  static core::Expected<std::shared_ptr<const FltGrid>> open_within(const std::filesystem::path& folder,
                                                                    const std::filesystem::path& file);
  FltGrid(const FltGrid&) = delete;
  FltGrid& operator=(const FltGrid&) = delete;

  [[nodiscard]] terrain::GridFrame frame() const override { return header_.frame; }
  void read(std::size_t column, std::size_t row, std::span<double> out) const override;
  [[nodiscard]] std::uint64_t read_failures() const override {
    return read_failures_.load(std::memory_order_relaxed);
  }
  /// Where the header declares no mark all of elevation::kCustomaryMarks count as no data, each height by
  /// itself: no part of a large file has to wait for what another one has. This is the first of them that was
  /// met.
  [[nodiscard]] std::optional<double> undeclared_mark() const override;

 private:
  FltGrid(const FltHeader& header, core::InputFile heights) : header_(header), heights_(std::move(heights)) {}
  using Open = std::function<core::Expected<core::InputFile>(const std::filesystem::path&)>;
  static core::Expected<std::shared_ptr<const FltGrid>> open_by(const Open& open,
                                                                const std::filesystem::path& file);
  [[nodiscard]] bool is_customary_mark(float height) const;

  FltHeader header_;
  core::InputFile heights_;
  mutable std::atomic<std::uint64_t> read_failures_{0};
  mutable std::atomic<unsigned> marks_met_{0};  ///< a bit for each of elevation::kCustomaryMarks
};

}  // namespace woodlouse::map
