#include "bench/lab/figures/plotting.h"

#include <sstream>

#include "bench/lab/problems/motion.h"
#include "bench/lab/report/table.h"

namespace woodlouse::lab {

std::string data_block(const std::string& name, const std::vector<std::vector<double>>& rows) {
  std::ostringstream out;
  out << name << " << EOD\n";
  for (const std::vector<double>& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) out << (i == 0 ? "" : " ") << result_text(row[i]);
    out << '\n';
  }
  out << "EOD\n";
  return out.str();
}

std::vector<std::vector<double>> plan_of(const std::vector<PathPoint>& path) {
  std::vector<std::vector<double>> rows;
  for (const PathPoint& p : path) rows.push_back({p.position.x, p.position.y});
  return rows;
}

std::vector<std::vector<double>> over_time(const std::vector<PathPoint>& path,
                                           const std::function<double(const PathPoint&)>& value) {
  std::vector<std::vector<double>> rows;
  for (const PathPoint& p : path) rows.push_back({p.t, value(p)});
  return rows;
}

std::string height_lines(const std::string& name, const document::AnySurface& surface, std::size_t count) {
  constexpr int kSide = 80;
  const terrain::Rectangle domain = std::visit([](const auto& s) { return s.domain(); }, surface);
  std::vector<std::vector<double>> rows;
  for (int j = 0; j <= kSide; ++j) {
    const double y = domain.y_min + (domain.y_max - domain.y_min) * j / kSide;
    for (int i = 0; i <= kSide; ++i) {
      const double x = domain.x_min + (domain.x_max - domain.x_min) * i / kSide;
      rows.push_back({x, y, sample_of(surface, {x, y}).z});
    }
    rows.emplace_back();
  }
  return data_block(name + "_heights", rows) + "set contour base\nset cntrparam levels " +
         std::to_string(count) + "\nunset surface\nset table " + name + "\nsplot " + name +
         "_heights using 1:2:3\nunset table\nunset contour\nset surface\n";
}

std::string place(double left, double bottom, double width, double height, double picture_width,
                  double picture_height) {
  std::ostringstream out;
  out << "set lmargin at screen " << left / picture_width << "\nset rmargin at screen "
      << (left + width) / picture_width << "\nset bmargin at screen " << bottom / picture_height
      << "\nset tmargin at screen " << (bottom + height) / picture_height << '\n';
  return out.str();
}

}  // namespace woodlouse::lab
