#include "shared/map/esri_ascii_grid.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <utility>

#include "shared/core/random.h"

namespace woodlouse::map {
namespace {

const std::string kRows = "1 2 3 4\n5 6 7 8\n9 10 11 12\n13 14 15 16\n";

std::string header(const std::string& more = {}) {
  return "ncols 4\nnrows 4\nxllcenter 100\nyllcenter 200\ncellsize 10\n" + more;
}

std::optional<elevation::FileGrid> parse(std::string_view text) {
  json::Problems problems("g.asc");
  auto grid = parse_esri_ascii_grid(text, problems);
  CHECK(grid.has_value() == (problems.count() == 0));
  return grid;
}

std::vector<std::string> problems_of(std::string_view text) {
  json::Problems problems("g.asc");
  CHECK_FALSE(parse_esri_ascii_grid(text, problems));
  std::vector<std::string> result;
  for (const core::Error& error : problems.errors()) result.push_back(error.text());
  return result;
}

bool begins(const std::string& text, std::string_view wanted) {
  INFO(text);
  CHECK(text.substr(0, wanted.size()) == wanted);
  return text.substr(0, wanted.size()) == wanted;
}

}  // namespace

TEST_CASE("the first row of a grid file is the north, its columns run from west to east") {
  const auto grid = parse(header() + kRows);
  REQUIRE(grid);
  CHECK(grid->columns == 4);
  CHECK(grid->rows == 4);
  CHECK(grid->at(0, 3) == 1.0);   // north-west
  CHECK(grid->at(3, 3) == 4.0);   // north-east
  CHECK(grid->at(0, 0) == 13.0);  // south-west
  CHECK(grid->at(3, 0) == 16.0);  // south-east
}

TEST_CASE("a corner lies half a cell outside the first centre, on each axis for itself") {
  const auto center = parse(header() + kRows);
  REQUIRE(center);
  CHECK(center->x_origin == 100.0);
  CHECK(center->y_origin == 200.0);
  const auto corner = parse("ncols 4\nnrows 4\nxllcorner 100\nyllcorner 200\ndx 10\ndy 4\n" + kRows);
  REQUIRE(corner);
  CHECK(corner->x_origin == 105.0);
  CHECK(corner->y_origin == 202.0);
  CHECK(corner->dx == 10.0);
  CHECK(corner->dy == 4.0);
  const auto mixed = parse("ncols 4\nnrows 4\nxllcorner 100\nyllcenter 200\ncellsize 10\n" + kRows);
  REQUIRE(mixed);
  CHECK(mixed->x_origin == 105.0);
  CHECK(mixed->y_origin == 200.0);
}

TEST_CASE("case, line breaks, CRLF, tabs, a byte order mark and the header's order change nothing") {
  const auto plain = parse(header("NODATA_value -9999\n") + kRows);
  REQUIRE(plain);
  const std::string odd =
      "\xEF\xBB\xBF"
      "CELLSIZE\t10.0\r\nNROWS 4\r\nNCols 4\r\nnodata_VALUE -9999\r\nYLLCENTER 2e2\r\nXllCenter +100\r\n"
      "1 2\r\n3 4 5 6 7\t8 9.0\r\n\r\n10 1.1e1 12 13 14 15 +16";
  const auto other = parse(odd);
  REQUIRE(other);
  CHECK(other->heights == plain->heights);
  CHECK(other->x_origin == plain->x_origin);
  CHECK(other->y_origin == plain->y_origin);
  CHECK(other->dx == plain->dx);
}

TEST_CASE("random grids of any shape read back, however their lines are broken") {
  core::Random random(3);
  for (int round = 0; round < 100; ++round) {
    const std::size_t columns = 4 + random.next() % 20;
    const std::size_t rows = 4 + random.next() % 20;
    std::vector<double> heights;
    std::string text = "ncols " + std::to_string(columns) + "\nnrows " + std::to_string(rows) +
                       "\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    for (std::size_t k = 0; k < columns * rows; ++k) {
      heights.push_back(static_cast<double>(random.next() % 4096) / 64.0 - 32.0);
      text += std::to_string(heights.back()) + (random.next() % 5 == 0 ? "\n" : " ");
    }
    const auto grid = parse(text);
    REQUIRE(grid);
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t i = 0; i < columns; ++i) {
        REQUIRE(grid->at(i, rows - 1 - j) == heights[j * columns + i]);
      }
    }
  }
}

TEST_CASE("a cell without data has no height: its declared mark, nan, inf, 1e30 and above") {
  const auto holes =
      parse(header("NODATA_value -9999\n") + "1 2 3 4\n5 -9999.0 7 8\n9 10 11 nan\n13 -3.4e38 15 inf\n");
  REQUIRE(holes);
  CHECK_FALSE(holes->undeclared_mark);
  for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{1, 2}, {3, 1}, {1, 0}, {3, 0}})
    CHECK(std::isnan(holes->at(i, j)));
  CHECK(std::count_if(holes->heights.begin(), holes->heights.end(), [](double z) { return std::isnan(z); }) ==
        4);
  CHECK(parse(header("NODATA_value nan\n") + kRows));
}

TEST_CASE("a usual mark of no data that is not declared is taken for one, and that is told") {
  for (const double mark : {-9999.0, -32768.0, -32767.0, -99999.0}) {
    const auto grid = parse(header() + std::to_string(mark) + " 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16");
    REQUIRE(grid);
    CHECK(std::isnan(grid->at(0, 3)));
    CHECK(grid->undeclared_mark == mark);
  }
  const auto other = parse(header("NODATA_value -1\n") + "-9999 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16");
  REQUIRE(other);
  CHECK(other->at(0, 3) == -9999.0);  // the file says what its mark is
}

TEST_CASE("every fault of a header is told, with its line") {
  const auto none = problems_of("1 2 3");
  REQUIRE(none.size() == 1);
  begins(none[0], "g.asc:1: is no grid of text: its header has ncols");
  const auto bare = problems_of("nodata_value 3 4");
  REQUIRE(bare.size() == 5);
  CHECK(bare[0] == "g.asc: ncols: is missing from the header");
  CHECK(bare[1] == "g.asc: nrows: is missing from the header");
  CHECK(bare[2] == "g.asc: cellsize: is missing from the header (or both dx and dy)");
  CHECK(bare[3] == "g.asc: xllcorner or xllcenter: is missing from the header");
  CHECK(bare[4] == "g.asc: yllcorner or yllcenter: is missing from the header");

  const auto wrong = problems_of(
      "ncols 3\nnrows 4.5\nxllcorner 0\nxllcenter 0\nyllcorner 1e300\ncellsize -1\nncols 4\ncelsize 3\n" +
      kRows);
  REQUIRE(wrong.size() == 6);
  begins(wrong[0], "g.asc:7: ncols: stands twice");
  begins(wrong[1], "g.asc:8: \"celsize\": is no header key (did you mean \"cellsize\"?)");
  begins(wrong[2], "g.asc:2: nrows: is no whole number");
  begins(wrong[3], "g.asc:6: cellsize: is not above 0");
  begins(wrong[4], "g.asc:4: xllcorner or xllcenter: both are given");
  begins(wrong[5], "g.asc:5: yllcorner or yllcenter: is out of range");

  begins(problems_of("ncols\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 1\n").front(),
         "g.asc:1: ncols: has no value");
  begins(problems_of("ncols 4\nnrows four\nxllcorner 0\nyllcorner 0\ncellsize 1\n").front(),
         "g.asc:2: nrows: \"four\" is no number");
  begins(problems_of("ncols 4\nnrows 4\nxllcorner inf\nyllcorner 0\ncellsize 1\n").front(),
         "g.asc:3: xllcorner: \"inf\" is no number");
  begins(problems_of("ncols 3000\nnrows 3000\nxllcorner 0\nyllcorner 0\ncellsize 1\n").front(),
         "g.asc:2: nrows: more than 4000000 heights");
}

TEST_CASE("too few and too many heights and words that are no numbers are errors") {
  begins(problems_of(header() + "1 2 3 4\n5 6\n").front(),
         "g.asc:8: row 2, column 3: the file ends here: 6 of 16 heights");
  begins(problems_of(header() + kRows + "17\n").front(), "g.asc:10: more than ncols * nrows = 16 heights");
  begins(problems_of(header() + "1 2 3 4\n5 6,5 7 8\n9 10 11 12\n13 14 15 16\n").front(),
         "g.asc:7: row 2, column 2: \"6,5\" is no number (the decimal sign is a point, not a comma");
  begins(problems_of(header() + "1 2 3 1e999 5 6 7 8 9 10 11 12 13 14 15 16").front(),
         "g.asc:6: row 1, column 4: ");
  CHECK(problems_of(std::string("\0\0\0\0", 4)).size() >= 1);
}

TEST_CASE("garbage in a large grid is one problem, not one a cell") {
  std::string text = "ncols 100\nnrows 100\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
  for (int k = 0; k < 10000; ++k) text += "x ";
  CHECK(problems_of(text).size() == 1);
}

TEST_CASE("no prefix of a grid file and no flipped byte of it does harm") {
  const std::string whole = header("NODATA_value -9999\n") + kRows;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    json::Problems problems("g.asc");
    const auto grid = parse_esri_ascii_grid(std::string_view(whole).substr(0, length), problems);
    CHECK(grid.has_value() == (problems.count() == 0));
  }
  core::Random random(5);
  for (int round = 0; round < 5000; ++round) {
    std::string text = whole;
    for (int k = 0; k < 3; ++k) text[random.next() % text.size()] = static_cast<char>(random.next() & 0xff);
    json::Problems problems("g.asc");
    const auto grid = parse_esri_ascii_grid(text, problems);
    CHECK(grid.has_value() == (problems.count() == 0));
  }
}

}  // namespace woodlouse::map
