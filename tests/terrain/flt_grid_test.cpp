#include "shared/map/flt_grid_file.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "shared/terrain/bicubic_spline.h"
#include "shared/terrain/tiled_bspline.h"
#include "tests/terrain/grids.h"

using namespace woodlouse;
using namespace woodlouse::map;

namespace {

/// A folder of its own for each test case, gone afterwards.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(std::filesystem::path(WOODLOUSE_BINARY_DIR) / "tests" / ("flt_grid_" + name)) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return path_ / name; }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(file(name), std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

 private:
  std::filesystem::path path_;
};

std::string float_bytes(const std::vector<float>& values, ByteOrder order) {
  std::string bytes;
  for (const float value : values) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
    for (int k = 0; k < 4; ++k) {
      const int shift = order == ByteOrder::kLittleEndian ? 8 * k : 24 - 8 * k;
      bytes.push_back(static_cast<char>(static_cast<unsigned char>(bits >> shift)));
    }
  }
  return bytes;
}

const std::string kHeader =
    "NCOLS 5\r\nnrows 4\nxllcorner 10\nyllcenter -2.5\ncellsize 2\nNODATA_value -9999\n";

/// 5 x 4 heights, north row first: 100 * row from north + column.
std::vector<float> counted() {
  std::vector<float> values;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 5; ++column) values.push_back(static_cast<float>(100 * row + column));
  }
  return values;
}

std::string refusal(const std::string& header) {
  const auto parsed = parse_flt_header(header, "big.hdr");
  return parsed.has_value() ? std::string() : parsed.error().text();
}

}  // namespace

TEST_CASE(
    "a float grid is read in either byte order, the file's first row in the north, corner and centre told "
    "apart") {
  for (const ByteOrder order : {ByteOrder::kLittleEndian, ByteOrder::kBigEndian}) {
    const Folder folder("order");
    folder.write("big.hdr", kHeader + (order == ByteOrder::kBigEndian ? "BYTEORDER MSBFIRST\n"
                                                                      : "byteorder LSBFIRST\n"));
    folder.write("big.flt", float_bytes(counted(), order));
    const auto grid = FltGrid::open(folder.file("big.flt"));
    REQUIRE(grid.has_value());
    const terrain::GridFrame frame = (*grid)->frame();
    CHECK(frame.columns == 5);
    CHECK(frame.rows == 4);
    CHECK(frame.x_origin == 11.0);
    CHECK(frame.y_origin == -2.5);
    CHECK(frame.dx == 2.0);
    std::vector<double> row(3);
    (*grid)->read(1, 0, row);
    CHECK(row == std::vector<double>{301, 302, 303});
    (*grid)->read(2, 3, row);
    CHECK(row == std::vector<double>{2, 3, 4});
  }
}

TEST_CASE("the header that GDAL writes is understood: upper left centre, xdim and ydim") {
  const auto header = parse_flt_header(
      "BYTEORDER      I\nLAYOUT         BIL\nNROWS          4\nNCOLS          5\nNBANDS         1\nNBITS     "
      "     32\n"
      "BANDROWBYTES   20\nTOTALROWBYTES  20\nPIXELTYPE      FLOAT\nULXMAP         7\nULYMAP         9\nXDIM  "
      "2\nYDIM  0.5\nNODATA nan\n",
      "gdal.hdr");
  REQUIRE(header.has_value());
  CHECK(header->frame.x_origin == 7.0);
  CHECK(header->frame.y_origin == 9.0 - 3 * 0.5);
  CHECK(header->frame.dx == 2.0);
  CHECK(header->frame.dy == 0.5);
  CHECK(std::isnan(header->no_data));
}

TEST_CASE("heights without data come as NaN, however the file spells them, and the surface has holes there") {
  const Folder folder("no_data");
  std::vector<float> values = counted();
  values[0] = -9999.0f;
  values[1] = -3.4028235e38f;
  values[2] = std::numeric_limits<float>::quiet_NaN();
  values[3] = std::numeric_limits<float>::infinity();
  folder.write("big.hdr", kHeader);
  folder.write("big.flt", float_bytes(values, ByteOrder::kLittleEndian));
  const auto grid = FltGrid::open(folder.file("big.flt"));
  REQUIRE(grid.has_value());
  std::vector<double> row(5);
  (*grid)->read(0, 3, row);
  for (int k = 0; k < 4; ++k) CHECK(std::isnan(row[static_cast<std::size_t>(k)]));
  CHECK(row[4] == 4.0);
  const terrain::TiledBSpline surface(*grid);
  CHECK_FALSE(surface.has_ground(12.0, 2.0));
  CHECK(surface.has_ground(12.0, -1.0));
}

TEST_CASE("what customarily marks no data is none where the header declares nothing, and there alone") {
  const Folder folder("marks");
  const std::string no_mark = "ncols 5\nnrows 4\nxllcorner 10\nyllcorner 0\ncellsize 2\n";
  std::vector<float> values = counted();
  values[1] = -99999.0f;
  values[2] = -32768.0f;
  values[15] = -9999.5f;  // deep, but no mark
  folder.write("big.flt", float_bytes(values, ByteOrder::kLittleEndian));
  folder.write("big.hdr", no_mark);
  const auto grid = FltGrid::open(folder.file("big.flt"));
  REQUIRE(grid.has_value());
  std::vector<double> row(5);
  (*grid)->read(0, 0, row);
  CHECK(row[0] == -9999.5);
  CHECK_FALSE((*grid)->undeclared_mark());
  (*grid)->read(0, 3, row);
  CHECK((std::isnan(row[1]) && std::isnan(row[2])));
  CHECK(row[3] == 3.0);
  CHECK((*grid)->undeclared_mark() == -32768.0);
  for (const char* declared : {"NODATA_value -1\n", "nodata nan\n", "NODATA -1e39\n"}) {
    folder.write("big.hdr", no_mark + declared);
    const auto other = FltGrid::open(folder.file("big.flt"));
    REQUIRE(other.has_value());
    (*other)->read(0, 3, row);
    CHECK(row[1] == -99999.0);  // the file says what its mark is
    CHECK_FALSE((*other)->undeclared_mark());
  }
}

TEST_CASE("the surface over a file is the surface over the same heights in memory") {
  const Folder folder("surface");
  terrain::HeightGrid grid = tests::smooth_grid(150, 90);
  std::vector<float> north_first;
  for (double& z : grid.heights) z = static_cast<double>(static_cast<float>(z));
  for (std::size_t j = grid.rows; j-- > 0;) {
    for (std::size_t i = 0; i < grid.columns; ++i) north_first.push_back(static_cast<float>(grid.at(i, j)));
  }
  folder.write("big.hdr", "ncols 150\nnrows 90\nxllcenter -1.5\nyllcenter 2.25\nxdim 0.5\nydim 0.25\n");
  folder.write("big.flt", float_bytes(north_first, ByteOrder::kLittleEndian));
  const auto source = FltGrid::open(folder.file("big.flt"));
  REQUIRE(source.has_value());
  const terrain::TiledBSpline on_disk(*source);
  const terrain::TiledBSpline in_memory(grid);
  const terrain::BicubicSpline global(grid);
  tests::at_random_points(grid.domain(), 1000, 5, [&](double x, double y) {
    REQUIRE(on_disk.sample(x, y).z == in_memory.sample(x, y).z);
    REQUIRE(on_disk.sample(x, y).zxy == in_memory.sample(x, y).zxy);
    REQUIRE(on_disk.sample(x, y).z == Approx(global.sample(x, y).z).margin(1e-11));
  });
}

TEST_CASE("a file that is cut while it is open becomes a hole and is counted, not an abort") {
  const Folder folder("cut");
  folder.write("big.hdr", kHeader);
  folder.write("big.flt", float_bytes(counted(), ByteOrder::kLittleEndian));
  const auto grid = FltGrid::open(folder.file("big.flt"));
  REQUIRE(grid.has_value());
  std::filesystem::resize_file(folder.file("big.flt"), 60);
  std::vector<double> row(5);
  (*grid)->read(0, 1, row);
  CHECK(row[0] == 200.0);
  CHECK((*grid)->read_failures() == 0);
  (*grid)->read(0, 0, row);
  CHECK(std::isnan(row[0]));
  CHECK((*grid)->read_failures() == 1);
}

TEST_CASE("bad headers and files are refused with what, where and what to do") {
  const auto says = [](const std::string& text, const std::string& part) {
    INFO(text);
    CHECK(text.find(part) != std::string::npos);
  };
  says(refusal("nrows 4\nxllcorner 0\nyllcorner 0\ncellsize 1\n"), "big.hdr: ncols is missing");
  says(refusal("ncols 5\nnrows 4\nyllcorner 0\ncellsize 1\n"), "xllcorner is missing");
  says(refusal("ncols 5\nnrows 4\nxllcorner 0\nyllcorner 0\n"), "cellsize is missing");
  says(refusal("ncols 5\nncols 5\n"), "big.hdr:2: ncols: stands twice");
  says(refusal("ncols 5.5\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 1\n"),
       "big.hdr:1: ncols: is no whole number");
  says(refusal("ncols 1e9\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 1\n"), "4 to 1000000");
  says(refusal("ncols five\n"), "big.hdr:1: ncols: \"five\" is no number");
  says(refusal("ncols\n"), "big.hdr:1: is no key and value");
  says(refusal("speed 5\n"), "\"speed\" is no header key");
  says(refusal("ncols 5\nnrows 4\nxllcorner 0\nxllcenter 0\nyllcorner 0\ncellsize 1\n"), "say the same");
  says(refusal("ncols 5\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize -1\n"), "above 0");
  says(refusal("ncols 5\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize nan\n"), "above 0");
  says(refusal(kHeader + "byteorder VMS_FLOAT\n"), "LSBFIRST or MSBFIRST");
  says(refusal(kHeader + "nbits 16\n"), "gdal_translate");
  says(refusal(kHeader + "totalrowbytes 24\n"), "without gaps");
  says(refusal(std::string(100, '\0')), "is no key and value");
  CHECK(refusal(kHeader).empty());

  const Folder folder("refused");
  says(FltGrid::open(folder.file("big.flt")).error().text(), "big.hdr: no such file");
  folder.write("big.hdr", kHeader);
  says(FltGrid::open(folder.file("big.flt")).error().text(), "big.flt: no such file");
  folder.write("big.flt", std::string(79, 'x'));
  says(FltGrid::open(folder.file("big.flt")).error().text(), "has 79 bytes, its header says 80");
}
