// A table of measurements: aligned with four digits for people, CSV with seven for programs. (What is
// computed, not measured, is printed with 17: exact_text.)
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "shared/core/error.h"

namespace woodlouse::lab {

/// 17 significant digits: read back, the same double.
std::string exact_text(double value);
/// Four and seven significant digits.
std::string short_text(double value);
std::string result_text(double value);

class Table {
 public:
  using Cell = std::variant<std::string, double>;

  explicit Table(std::vector<std::string> header) : header_(std::move(header)) {}
  /// REQUIRES as many cells as the header has, and no quotation marks in them.
  void add(std::vector<Cell> row);

  [[nodiscard]] const std::vector<std::vector<Cell>>& rows() const { return rows_; }
  /// NaN is printed as nothing.
  void print(std::ostream& out) const;
  /// `preamble`: lines that begin with #, before the header.
  [[nodiscard]] core::Expected<void> write_csv(const std::filesystem::path& file,
                                               std::string_view preamble) const;

 private:
  std::vector<std::string> header_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace woodlouse::lab
