// 5.1: what a value of the global spline is made of: the splines along all rows, their values at one x, and
// the spline along the column through those.
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "bench/lab/figures/figures.h"
#include "bench/lab/figures/plotting.h"
#include "bench/lab/problems/motion.h"

namespace woodlouse::lab {
namespace {

constexpr std::size_t kGrid = 5;  // "the illustration shows g=5"
constexpr auto kFunction = terrain::FunctionName::kWavyPot;
constexpr std::size_t kRedRow = 2;         ///< "one row is shown red"
constexpr core::Vec2 kPoint{0.43, 0.276};  ///< between knots in both directions
constexpr int kPieces = 100;

struct Construction {
  std::vector<std::vector<double>> knots, other_rows, red_row, red_knots, values, column;
};

/// Through a row of knots the surface is that row's spline; through a column at any x it is the spline
/// through the rows' values there (ZxySpline, 5.4.6). So all of it is the document's own evaluation.
Construction construct(const document::AnySurface& spline, const terrain::HeightGrid& grid) {
  const auto point = [&](double x, double y) {
    return std::vector<double>{x, y, sample_of(spline, {x, y}).z};
  };
  const auto along = [](double origin, double step, std::size_t i) {
    return origin + step * static_cast<double>(i);
  };
  Construction c;
  for (std::size_t j = 0; j < grid.rows; ++j) {
    const double y = along(grid.y_origin, grid.dy, j);
    auto& row = j == kRedRow ? c.red_row : c.other_rows;
    for (std::size_t i = 0; i <= kPieces; ++i) row.push_back(point(along(-1.0, 2.0 / kPieces, i), y));
    row.insert(row.end(), 2, {});  // one empty line would join the rows to a mesh
    for (std::size_t i = 0; i < grid.columns; ++i)
      (j == kRedRow ? c.red_knots : c.knots).push_back({along(grid.x_origin, grid.dx, i), y, grid.at(i, j)});
    c.values.push_back(point(kPoint.x, y));
  }
  for (std::size_t i = 0; i <= kPieces; ++i)
    c.column.push_back(point(kPoint.x, along(-1.0, 2.0 / kPieces, i)));
  return c;
}

void add_rows(Table& table, const std::string& what, const std::vector<std::vector<double>>& rows) {
  for (const std::vector<double>& row : rows) {
    if (!row.empty()) table.add({what, row[0], row[1], row[2]});
  }
}

std::string picture(const Construction& c, const std::vector<double>& result) {
  std::ostringstream script;
  script << data_block("$knots", c.knots) << data_block("$rows", c.other_rows)
         << data_block("$red_row", c.red_row) << data_block("$red_knots", c.red_knots)
         << data_block("$values", c.values) << data_block("$column", c.column)
         << data_block("$result", {result}) << "set title 'Global spline, g = 5: z at x = " << result[0]
         << ", y = " << result[1] << "'\n"
         << "set xlabel 'x'\nset ylabel 'y'\nset zlabel 'z' offset 2,0\nset xtics 0.5 offset 0,-0.4\n"
         << "set ytics 0.5 offset 0.6,-0.2\nset ztics 0.5\nset xyplane at -0.1\nset grid lc rgb '#e0e0e0'\n"
         << "set view 50,58,1.0,1.2\nset key at screen 0.98,0.92 right top samplen 2 spacing 1.1\n"
         << "splot $rows with lines lc rgb '#a0a0a0' lw 1 title 'splines along the rows',"
         << " $knots with points pt 7 ps 0.45 lc rgb '#606060' title 'knots',"
         << " $red_row with lines lc rgb '#d02020' lw 2 title 'one of the rows',"
         << " $red_knots with points pt 7 ps 0.6 lc rgb '#d02020' notitle,"
         << " $column with lines lc rgb '#2050c0' lw 2 title 'spline along the column',"
         << " $values with points pt 7 ps 0.9 lc rgb '#2050c0' title \"the rows' values at x\","
         << " $result with points pt 7 ps 1.7 lc rgb '#d02020' title 'the value'\n";
  return script.str();
}

}  // namespace

core::Expected<void> draw_global_spline(const Output& output, Findings& findings) {
  const terrain::HeightGrid grid = terrain::sample_function(kFunction, 1.0, kGrid);
  const auto spline = document::interpolate(document::Interpolation::kNaturalDocument, grid);
  if (!spline) return tl::unexpected(spline.error());
  const auto ours = document::interpolate(document::Interpolation::kNatural, grid);
  if (!ours) return tl::unexpected(ours.error());
  const Construction parts = construct(*spline, grid);
  const std::vector<double> result = {kPoint.x, kPoint.y, sample_of(*spline, kPoint).z};
  if (auto done = output.draw(picture(parts, result), "document-5.1-spline", 760, 560); !done) return done;

  Table table({"what", "x", "y", "z"});
  for (const auto* knots : {&parts.knots, &parts.red_knots}) add_rows(table, "knot", *knots);
  for (const auto* rows : {&parts.other_rows, &parts.red_row}) add_rows(table, "row", *rows);
  add_rows(table, "value", parts.values);
  add_rows(table, "column", parts.column);
  add_rows(table, "result", {result});
  findings.note("5.1", "the value, by row splines and a column spline", result[2], "m");
  findings.note("5.1", "the same by 16 coefficients a cell: apart",
                std::fabs(sample_of(*ours, kPoint).z - result[2]), "m");
  return output.write(table, "document-5.1");
}

}  // namespace woodlouse::lab
