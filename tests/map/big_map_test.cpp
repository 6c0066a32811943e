#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <variant>

#include "shared/core/random.h"
#include "shared/core/stable_hash.h"
#include "shared/map/canonical_map.h"
#include "shared/map/height_survey.h"
#include "shared/map/map_file.h"
#include "tests/support/big_map_files.h"

namespace woodlouse::map {
namespace {

using tests::BigMapFiles;

std::shared_ptr<const Map> load(const std::filesystem::path& file) {
  auto map = load_map(file);
  if (!map) FAIL(map.error().text());
  return *map;
}

std::string error_of(const std::filesystem::path& file) {
  const auto map = load_map(file);
  return map ? std::string("no error") : map.error().text();
}

void check_says(const std::string& text, const std::string& part) {
  INFO(text);
  CHECK(text.find(part) != std::string::npos);
}

/// What a map asks a surface for, at random points.
template <typename Check>
void at_points(const terrain::Rectangle& d, const Check& check) {
  core::Random random(3);
  for (int k = 0; k < 400; ++k) {
    const double x = d.x_min + (d.x_max - d.x_min) * random.uniform();
    check(x, d.y_min + (d.y_max - d.y_min) * random.uniform());
  }
}

}  // namespace

TEST_CASE("a small float grid becomes the bicubic spline over the same heights, its middle at the origin") {
  const BigMapFiles files("small");
  const auto map = load(files.map(R"(,"scale":0.5)"));
  REQUIRE(std::holds_alternative<terrain::BicubicSpline>(map->terrain->surface()));
  CHECK(map->terrain->domain() == terrain::Rectangle{-50.0, -37.25, 50.0, 37.25});
  CHECK(map->terrain->sample(-50.0 + 10 * 0.5, -37.25 + 20 * 0.5).z ==
        Approx(0.5 * BigMapFiles::wave(10, 20)).epsilon(1e-6));
  CHECK(map->canonical.find("\"heights\":") != std::string::npos);
}

TEST_CASE("in tiles the ground is that of the spline in memory to 1e-12, and the map names its file") {
  const BigMapFiles files("tiles");
  const auto whole = load(files.map(""));
  const auto tiled = load(files.map(R"(,"storage":"tiles")"));
  REQUIRE(std::holds_alternative<terrain::TiledGround>(tiled->terrain->surface()));
  REQUIRE(tiled->terrain->domain() == whole->terrain->domain());
  CHECK(tiled->definition.spawns.size() == whole->definition.spawns.size());
  CHECK(tiled->detail == Detail::kExact);
  at_points(tiled->terrain->domain(), [&](double x, double y) {
    const auto a = tiled->terrain->sample(x, y), b = whole->terrain->sample(x, y);
    REQUIRE(a.z == Approx(b.z).margin(4e-12));
    REQUIRE(a.zx == Approx(b.zx).margin(4e-12));
    REQUIRE(a.zyy == Approx(b.zyy).margin(4e-11));
  });
  CHECK(tiled->canonical.size() < 2000);
  CHECK(tiled->hash == core::stable_hash(tiled->canonical));
  files.write("again.json", tiled->canonical);
  CHECK(load(files.file("again.json"))->canonical == tiled->canonical);
}

TEST_CASE("a grid of more knots than are read whole is stepped on from its file, opened without reading it") {
  const BigMapFiles files("by_size");
  files.write("hills.hdr", "ncols 2001\nnrows 2000\nxllcenter 0\nyllcenter 0\ncellsize 1\n");
  std::filesystem::resize_file(files.file("hills.flt"), 0);
  std::filesystem::resize_file(files.file("hills.flt"), 4ull * 2001 * 2000);
  const auto map = load(files.map(""));
  const auto* ground = std::get_if<terrain::TiledGround>(&map->terrain->surface());
  REQUIRE(ground != nullptr);
  CHECK(ground->tiles().counters().built == 0);
  CHECK(map->terrain->sample(12.5, -800.25).z == 0.0);
  CHECK(ground->tiles().counters().built == 1);
  check_says(error_of(files.map(R"(,"storage":"whole")")),
             "hills.json:1: terrain: more than 4000000 knots can't be read whole");
}

TEST_CASE(
    "knots without data are filled from their shores, and so are heights past 1000 km, read whole or in "
    "tiles") {
  const auto with_holes = [](std::size_t i, std::size_t j) {
    if (i >= 40 && i < 100 && j >= 30 && j < 90) return -9999.0;
    if (i == 150 && j == 120) return 3e6;
    return BigMapFiles::wave(i, j);
  };
  const BigMapFiles files("holes", 201, 150, with_holes);
  const auto whole = load(files.map(R"(,"fill_level":-7)"));
  const auto tiled = load(files.map(R"(,"fill_level":-7,"storage":"tiles")"));
  const auto at = [](const Map& map, double i, double j) {
    return map.terrain->sample(-100.0 + i, -74.5 + j).z;
  };
  for (const auto& map : {whole, tiled}) {
    CHECK(at(*map, 70, 60) == Approx(-7.0).margin(1e-6));
    CHECK(std::fabs(at(*map, 150, 120)) < 3.0);
    CHECK(at(*map, 41, 60) == Approx(BigMapFiles::wave(39, 60)).margin(1.0));
  }
  at_points(whole->terrain->domain(), [&](double x, double y) {
    REQUIRE(tiled->terrain->sample(x, y).z == Approx(whole->terrain->sample(x, y).z).margin(1e-7));
  });
}

TEST_CASE("an undeclared -9999 is a hole, not a pit of 10 km, read whole or in tiles, and one line says so") {
  const auto with_holes = [](std::size_t i, std::size_t j) {
    return i >= 40 && i < 44 && j >= 30 && j < 33 ? -9999.0 : BigMapFiles::wave(i, j);
  };
  const BigMapFiles files("undeclared", 201, 150, with_holes);
  files.write("hills.hdr", "ncols 201\nnrows 150\nxllcenter 0\nyllcenter 0\ncellsize 1\n");
  const auto whole = load(files.map(R"(,"scale":0.5)"));
  CHECK(whole->definition.ground_note ==
        "12 of 30150 heights were filled from their shores, -9999 was taken for no data, which the file does "
        "not say");
  const auto tiled = load(files.map(R"(,"scale":0.5,"storage":"tiles")"));
  CHECK(tiled->definition.ground_note == "-9999 was taken for no data, which the file does not say");
  for (const auto& map : {whole, tiled}) {
    at_points(map->terrain->domain(),
              [&](double x, double y) { REQUIRE(std::fabs(map->terrain->sample(x, y).z) < 1.5); });
    CHECK(std::fabs(map->terrain->sample(0.5 * (42 - 100), 0.5 * (31 - 74.5)).z) < 1.5);
  }
  files.write("hills.hdr",
              "ncols 201\nnrows 150\nxllcenter 0\nyllcenter 0\ncellsize 1\nNODATA_value -1234\n");
  check_says(error_of(files.map("")), "steeper than 100 m a metre");
}

TEST_CASE("the fingerprint tells another file, and a map may demand it") {
  const BigMapFiles files("fingerprint");
  const auto map = load(files.map(R"(,"storage":"tiles")"));
  const auto fingerprint = std::get<TiledTerrain>(map->definition.terrain).fingerprint;
  const std::string pinned = R"(,"storage":"tiles","fingerprint":")" + core::to_hex(fingerprint) + "\"";
  CHECK(load(files.map(pinned))->hash == map->hash);
  files.alter(200, 149, 201, 1.5f);
  CHECK(load(files.map(R"(,"storage":"tiles")"))->hash != map->hash);
  check_says(error_of(files.map(pinned)), "fingerprint: is not the fingerprint of ");
  check_says(error_of(files.map(R"(,"fingerprint":7)")), "take the file the map was made with");
}

TEST_CASE(
    "the overview covers the whole domain with at most 257 knots a side, each of its nearest knot's height") {
  const BigMapFiles files("overview", 700, 90, BigMapFiles::wave);
  const auto map = load(files.map(R"(,"storage":"tiles")"));
  const terrain::HeightGrid& overview = std::get<TiledTerrain>(map->definition.terrain).overview;
  CHECK(overview.columns == kOverviewSide);
  CHECK(overview.rows == 90);
  const terrain::Rectangle a = overview.domain(), b = map->terrain->domain();
  CHECK(a.x_min == b.x_min);
  CHECK(a.x_max == Approx(b.x_max));
  CHECK(a.y_max == Approx(b.y_max));
  for (std::size_t i = 0; i < overview.columns; i += 16) {
    const double nearest = std::round(static_cast<double>(i) * 699.0 / 256.0);
    CHECK(overview.at(i, 33) ==
          Approx(BigMapFiles::wave(static_cast<std::size_t>(nearest), 33)).margin(0.5 / 1024 + 1e-6));
  }
}

TEST_CASE(
    "a client's map of an overview keeps the definition's text and hash, and says that it is no ground to "
    "compute on") {
  const BigMapFiles files("client");
  const auto map = load(files.map(R"(,"storage":"tiles")"));
  const terrain::HeightGrid& overview = std::get<TiledTerrain>(map->definition.terrain).overview;
  const auto seen = parse_overview(map->canonical, "the server's map", overview);
  REQUIRE(seen);
  CHECK((*seen)->detail == Detail::kOverview);
  CHECK((*seen)->hash == map->hash);
  CHECK((*seen)->definition.spawns.size() == 8);
  CHECK((*seen)->terrain->sample(0.0, 0.0).z == Approx(map->terrain->sample(0.0, 0.0).z).margin(0.05));
  CHECK_FALSE(parse_map(map->canonical, "the server's map", {}));
  terrain::HeightGrid broken = overview;
  broken.heights.back() = 2e6;
  CHECK_FALSE(parse_overview(map->canonical, "m", broken));
  broken.heights.pop_back();
  CHECK_FALSE(parse_overview(map->canonical, "m", broken));
}

TEST_CASE("what is wrong with a float grid is told with its place and what to do") {
  const BigMapFiles files("errors");
  check_says(error_of(files.map(R"(,"storage":"disk")")),
             "terrain.storage: is none of its choices (whole or tiles");
  check_says(error_of(files.map(R"(,"tiles":true)")), "terrain.tiles");
  check_says(error_of(files.map(R"(,"scale":1e-5)")), "knots less than 1 mm");
  check_says(error_of(files.write("natural.json", R"({"name":"n","surface":"natural_spline",
      "terrain":{"file":"hills.flt","storage":"tiles"}})")),
             "natural.json:1: surface: natural ends need all heights at once");
  std::filesystem::remove(files.file("hills.hdr"));
  check_says(error_of(files.map("")), "hills.hdr: no such file (the header of hills.flt");
  const std::string header = "ncols 201\nnrows 150\nxllcenter 0\nyllcenter 0\ncellsize 1\n";
  files.write("hills.hdr", header + "byteorder VAX\n");
  check_says(error_of(files.map("")), "hills.hdr:6: byteorder: \"vax\" can't be read (LSBFIRST or MSBFIRST)");
  files.write("hills.hdr", header + "nbits 16\n");
  check_says(error_of(files.map("")), "gdal_translate");
  files.write("hills.hdr", header);
  std::filesystem::resize_file(files.file("hills.flt"), 4 * 201 * 150 - 1);
  check_says(error_of(files.map("")), "has 120599 bytes, its header says 120600");
  const BigMapFiles empty("errors_empty", 8, 8, [](std::size_t, std::size_t) { return -9999.0; });
  check_says(error_of(empty.map("")),
             "hills.flt: has no heights, only knots without data (check NODATA_value and byteorder");
  check_says(error_of(empty.map(R"(,"storage":"tiles")")), "has no heights");
  std::filesystem::remove(empty.file("hills.flt"));
  check_says(error_of(empty.map("")), "hills.flt: no such file (the heights that hills.hdr describes");
}

}  // namespace woodlouse::map
