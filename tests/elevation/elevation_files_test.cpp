// Elevation files as people have them, each as the terrain of a map.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <variant>

#include "shared/core/stable_hash.h"
#include "shared/elevation/degrees.h"
#include "shared/elevation/hgt_grid_file.h"
#include "shared/elevation/surfer_ascii.h"
#include "shared/map/map_file.h"

using namespace woodlouse;
namespace fs = std::filesystem;

namespace {

/// A folder of its own with the cases' files, gone afterwards.
struct Folder {
  explicit Folder(const std::string& name)
      : path(fs::path(WOODLOUSE_BINARY_DIR) / "tests" / ("elevation_" + name)) {
    fs::remove_all(path);
    fs::create_directories(path);
    for (const auto& entry : fs::directory_iterator(fs::path(WOODLOUSE_SOURCE_DIR) / "tests/elevation/cases"))
      fs::copy(entry.path(), path);
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path / name, std::ios::binary) << bytes;
  }
  [[nodiscard]] fs::path map(const std::string& file, const std::string& more = {}) const {
    write("m.json", R"({"name":"m","terrain":{"file":")" + file + "\"" + more + "}}");
    return path / "m.json";
  }
  [[nodiscard]] std::shared_ptr<const map::Map> load(const std::string& file,
                                                     const std::string& more = {}) const {
    auto map = map::load_map(this->map(file, more));
    if (!map) FAIL(map.error().text());
    return *map;
  }
  /// The one line that `check` says.
  [[nodiscard]] std::string error(const std::string& file, const std::string& more = {}) const {
    const auto errors = map::check_map(map(file, more));
    REQUIRE(errors.size() == 1);
    return errors.front().text();
  }

  fs::path path;
};

const terrain::HeightGrid& grid_of(const map::Map& map) {
  return std::get<terrain::HeightGrid>(map.definition.terrain);
}

bool has(const std::string& text, const std::string& part) {
  INFO(text);
  CHECK(text.find(part) != std::string::npos);
  return text.find(part) != std::string::npos;
}

/// An SRTM tile of `side` knots: hills of 300 m with a void of 60 knots and some of one.
std::string tile(std::size_t side) {
  std::string bytes;
  for (std::size_t j = 0; j < side; ++j) {
    for (std::size_t i = 0; i < side; ++i) {
      const double u = static_cast<double>(i % 100) / 100.0 - 0.5,
                   v = static_cast<double>(j % 90) / 90.0 - 0.5;
      int height = 400 + static_cast<int>(300.0 * (0.25 - u * u) * (1.0 - v * v));
      if (i > 500 && i < 560 && j > 500 && j < 560) height = -32768;
      if ((i * 7 + j * 13) % 1009 == 0) height = -32768;
      const auto raw = static_cast<std::uint16_t>(static_cast<std::int16_t>(height));
      bytes.push_back(static_cast<char>(raw >> 8));
      bytes.push_back(static_cast<char>(raw & 0xff));
    }
  }
  return bytes;
}

}  // namespace

TEST_CASE("a hole is filled from its shore, one line says so, and the heights enter the map's hash") {
  const Folder folder("hole");
  const auto map = folder.load("nodata_hole.asc");
  CHECK(map->definition.ground_note == "3 of 36 heights were filled from their shores");
  const auto& grid = grid_of(*map);
  REQUIRE(grid.columns == 6);
  for (const double z : grid.heights) CHECK((z >= -2.86 && z <= 4.96));
  // The mean of its neighbours, which is what harmonic means.
  CHECK(grid.at(2, 2) == Approx(0.25 * (grid.at(1, 2) + grid.at(3, 2) + grid.at(2, 1) + grid.at(2, 3))));
  const auto again = map::parse_canonical_map(map->canonical, "again");
  REQUIRE(again);
  CHECK((*again)->hash == map->hash);
  CHECK(core::to_hex(map->hash) == "1c9f4f64be45418e");
}

TEST_CASE("a rim without data is cut off, so that the wall stands where data end, or filled") {
  const Folder folder("rim");
  const auto cut = folder.load("nodata_rim.asc");
  CHECK(grid_of(*cut).columns == 5);
  CHECK(grid_of(*cut).rows == 5);
  CHECK(grid_of(*cut).at(0, 4) == 1.24);
  CHECK(cut->terrain->domain() == terrain::Rectangle{-20.0, -20.0, 20.0, 20.0});
  CHECK(cut->definition.ground_note ==
        "a rim without data was cut off: 1 row in the north, 1 column in the east");
  const auto filled = folder.load("nodata_rim.asc", R"(,"rim":"fill")");
  CHECK(grid_of(*filled).columns == 6);
  CHECK(filled->definition.ground_note == "11 of 36 heights were filled from their shores");
  has(folder.error("nodata_rim.asc", R"(,"rim":"ocean")"),
      "is none of its choices (cut (the default) or fill)");
}

TEST_CASE("an undeclared -9999, half of all heights missing, and a cliff are ground") {
  const Folder folder("marks");
  has(folder.load("undeclared_9999.asc")->definition.ground_note,
      "1 of 36 heights were filled from their shores, -9999 was taken for no data");
  const auto many = folder.load("many_nodata.asc");
  has(many->definition.ground_note, " of 1600 heights were filled from their shores");
  for (const double z : grid_of(*many).heights) CHECK(std::fabs(z) < 100.0);
  CHECK(folder.load("cliff.asc")->definition.ground_note.empty());
}

TEST_CASE("degrees become metres by latitude, the same bits everywhere") {
  const Folder folder("degrees");
  const auto map = folder.load("degrees.asc");
  CHECK(map->definition.ground_note == "degrees at latitude 44: a cell is 22.28 m by 30.865 m");
  CHECK(grid_of(*map).dx == Approx(22.28).margin(1e-3));
  CHECK(grid_of(*map).dy == Approx(30.865).margin(1e-3));
  CHECK(core::to_hex(map->hash) == "27e22cd9dd1b821c");
  CHECK(elevation::metres_a_degree(0.0).x == Approx(111319.5).margin(1.0));
  CHECK(elevation::metres_a_degree(0.0).y == Approx(110574.3).margin(1.0));
  CHECK(elevation::metres_a_degree(60.0).x == Approx(55800.0).margin(1.0));
  CHECK(elevation::metres_a_degree(-60.0).y == Approx(111412.3).margin(1.0));
  has(folder.error("degrees.asc", R"(,"unit":"metres")"), "less than 1 mm");
}

TEST_CASE("what is no grid is told by its first bytes, with the one command that converts it") {
  const Folder folder("foreign");
  CHECK(folder.error("geotiff.asc") == (folder.path / "geotiff.asc").string() +
                                           ": is a GeoTIFF, not a grid that is read here (gdal_translate -of "
                                           "AAIGrid geotiff.asc geotiff_grid.asc)");
  folder.write("p.png", "\x89PNG\r\n\x1a\n");
  has(folder.error("p.png"), "(gdal_translate -of AAIGrid -ot Float32 p.png p.asc)");
  folder.write("b.grd", "DSBB....");
  has(folder.error("b.grd"), "is a Surfer 6 binary grid");
  has(folder.error("decimal_comma.asc"),
      "decimal_comma.asc:5: cellsize: \"10,0\" is no number (the decimal sign");
}

TEST_CASE("Surfer's grids of text are read, the first row in the south") {
  const Folder folder("surfer");
  const auto map = folder.load("surfer.grd");
  CHECK(grid_of(*map).at(0, 0) == 2.0);
  CHECK(grid_of(*map).at(5, 5) == -1.47);
  CHECK(grid_of(*map).dx == 10.0);
  for (const char* wrong : {"DSAA\n3 6\n", "DSAA\n6 6\n0 50\n50 0\n", "DSAA\n4 4\n0 1\n0 1\n0 1\n1 2 x",
                            "DSAA\n3000 3000\n0 1\n0 1\n0 1\n1", "DSAA\n4 4\n0 1\n0 1\n0 1\n1 2"}) {
    const auto grid = elevation::parse_surfer_ascii(wrong, "s.grd", 4'000'000);
    REQUIRE_FALSE(grid);
    has(grid.error().where, "s.grd");
  }
}

TEST_CASE("an SRTM tile says by its name where it lies, or the map does") {
  const auto is = [](std::string_view name, double longitude, double latitude) {
    const auto corner = elevation::corner_of_name(name);
    return corner && corner->x == longitude && corner->y == latitude;
  };
  CHECK(is("N47E011.hgt", 11.0, 47.0));
  CHECK(is("s37w174_void.hgt", -174.0, -37.0));
  for (const char* none : {"hill.hgt", "N47E11.hgt", "N99E011.hgt", "E011N47.hgt", ""})
    CHECK_FALSE(elevation::corner_of_name(none));
  const Folder folder("srtm");
  folder.write("N47E011.hgt", tile(1201));
  const auto map = folder.load("N47E011.hgt");
  has(map->definition.ground_note, "degrees at latitude 47.5: a cell is 62.");
  has(map->definition.ground_note, " heights were filled from their shores");
  CHECK(grid_of(*map).columns == 1201);
  for (const double z : grid_of(*map).heights) REQUIRE((z >= 300.0 && z <= 800.0));
  folder.write("hill.hgt", tile(1201));
  has(folder.error("hill.hgt"), "give its south-western corner: \"corner\": [11, 47]");
  CHECK(folder.load("hill.hgt", R"(,"corner":[11,47])")->hash == map->hash);
  folder.write("N47E012.hgt", "short");
  has(folder.error("N47E012.hgt"), "has 5 bytes, which is no SRTM tile");
}

TEST_CASE("a tile of 1 arc second is stepped on from its file, and its text leads back to it") {
  const Folder folder("srtm_1");
  folder.write("N47E011.hgt", tile(3601));
  const auto map = folder.load("N47E011.hgt", R"(,"fill_level":450)");
  const auto& tiled = std::get<map::TiledTerrain>(map->definition.terrain);
  CHECK(tiled.is_in_degrees);
  CHECK(tiled.heights->frame().dy == Approx(30.88).margin(0.01));
  CHECK(std::isfinite(map->terrain->sample(1.0, 2.0).zxx));
  folder.write("again.json", map->canonical);
  const auto again = map::load_map(folder.path / "again.json");
  REQUIRE(again);
  CHECK((*again)->hash == map->hash);
}

TEST_CASE("a float grid may have xdim and ydim, apart or in degrees") {
  const Folder folder("flt");
  folder.write("a.hdr", "ncols 4\nnrows 4\nulxmap 10.0\nulymap 47.0\nxdim 0.001\nydim 0.002\nnbits 32\n");
  std::string bytes;
  for (int k = 0; k < 16; ++k) bytes += std::string("\0\0\0", 3) + (k % 2 == 0 ? '\x41' : '\x42');  // 8, 32
  folder.write("a.flt", bytes);
  const auto map = folder.load("a.flt");
  has(map->definition.ground_note, "degrees at latitude 47");
  CHECK(grid_of(*map).dy > 2.0 * grid_of(*map).dx);
}
