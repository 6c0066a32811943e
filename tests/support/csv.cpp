#include "tests/support/csv.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace woodlouse::tests {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

}  // namespace

const std::string& CsvTable::text(std::size_t row, const std::string& column) const {
  const auto at = std::find(header.begin(), header.end(), column);
  if (at == header.end()) throw std::runtime_error("no column " + column);
  return rows.at(row).at(static_cast<std::size_t>(at - header.begin()));
}

double CsvTable::number(std::size_t row, const std::string& column) const {
  return std::stod(text(row, column));
}

CsvTable read_reference(const std::string& name) {
  std::ifstream file(std::string(WOODLOUSE_SOURCE_DIR) + "/tests/reference/" + name);
  if (!file) throw std::runtime_error("cannot read tests/reference/" + name);
  CsvTable table;
  std::string line;
  std::getline(file, line);
  table.header = split(line);
  while (std::getline(file, line)) {
    if (!line.empty()) table.rows.push_back(split(line));
  }
  return table;
}

}  // namespace woodlouse::tests
