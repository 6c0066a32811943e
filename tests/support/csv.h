// Reads the reference tables: a header line, then rows of text and numbers.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace woodlouse::tests {

struct CsvTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;

  /// The number in that row under that heading; throws where there is none.
  [[nodiscard]] double number(std::size_t row, const std::string& column) const;
  [[nodiscard]] const std::string& text(std::size_t row, const std::string& column) const;
};

/// A file of tests/reference; throws when it can't be read.
CsvTable read_reference(const std::string& name);

}  // namespace woodlouse::tests
