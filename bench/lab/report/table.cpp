#include "bench/lab/report/table.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <fstream>
#include <utility>

namespace woodlouse::lab {
namespace {

std::string text_of(double value, int digits) {
  std::array<char, 40> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits);
  return {buffer.data(), end.ptr};
}

std::string shown(const Table::Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  const double value = std::get<double>(cell);
  return std::isnan(value) ? std::string() : short_text(value);
}

/// As CSV has it: quoted where it holds a comma.
std::string field_text(const std::string& text) {
  return text.find(',') == std::string::npos ? text : '"' + text + '"';
}

}  // namespace

std::string exact_text(double value) { return text_of(value, 17); }
std::string short_text(double value) { return text_of(value, 4); }
std::string result_text(double value) { return text_of(value, 7); }

void Table::add(std::vector<Cell> row) {
  assert(row.size() == header_.size());
  for (const Cell& cell : row)
    assert(!std::holds_alternative<std::string>(cell) ||
           std::get<std::string>(cell).find('"') == std::string::npos);
  rows_.push_back(std::move(row));
}

void Table::print(std::ostream& out) const {
  std::vector<std::size_t> width;
  for (const std::string& name : header_) width.push_back(name.size());
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], shown(row[i]).size());
  }
  const auto put = [&](std::size_t i, const std::string& text, bool left) {
    const std::string space(width[i] - text.size(), ' ');
    out << (left ? text + space : space + text) << (i + 1 == width.size() ? "\n" : "  ");
  };
  for (std::size_t i = 0; i < header_.size(); ++i) put(i, header_[i], i == 0);
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      put(i, shown(row[i]), std::holds_alternative<std::string>(row[i]));
    }
  }
}

core::Expected<void> Table::write_csv(const std::filesystem::path& file, std::string_view preamble) const {
  std::ofstream out(file);
  out << preamble;
  for (std::size_t i = 0; i < header_.size(); ++i) out << (i == 0 ? "" : ",") << header_[i];
  out << '\n';
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i != 0) out << ',';
      if (const auto* text = std::get_if<std::string>(&row[i])) {
        out << field_text(*text);
      } else {
        out << result_text(std::get<double>(row[i]));
      }
    }
    out << '\n';
  }
  out.close();
  if (!out) return core::fail(file.string(), "can't be written", "does its folder exist? --out names it");
  return {};
}

}  // namespace woodlouse::lab
