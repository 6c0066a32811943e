#include "shared/elevation/file_kind.h"

#include <array>

namespace woodlouse::elevation {
namespace {

struct Kind {
  std::string_view begins;
  std::string_view name;
  std::string_view options;  ///< of gdal_translate, besides the format
};

using namespace std::string_view_literals;

constexpr std::array<Kind, 12> kKinds = {{
    {"II*\0"sv, "a GeoTIFF", ""},
    {"MM\0*"sv, "a GeoTIFF", ""},
    {"II+\0"sv, "a GeoTIFF", ""},
    {"MM\0+"sv, "a GeoTIFF", ""},
    {"\x89PNG"sv, "a PNG picture", "-ot Float32 "},
    {"\xFF\xD8\xFF"sv, "a JPEG picture", "-ot Float32 "},
    {"DSBB"sv, "a Surfer 6 binary grid", ""},
    {"DSRB"sv, "a Surfer 7 binary grid", ""},
    {"\x89HDF"sv, "an HDF or NetCDF file", ""},
    {"CDF\x01"sv, "a NetCDF file", ""},
    {"CDF\x02"sv, "a NetCDF file", ""},
    {"PK\x03\x04"sv, "a ZIP archive", "unzip"},
}};

/// `path` with another ending.
std::string renamed(const std::string& path, std::string_view ending) {
  const std::size_t slash = path.rfind('/');
  const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
  const std::size_t dot = path.rfind('.');
  const bool has_ending = dot != std::string::npos && dot > name;
  const std::string stem = path.substr(name, has_ending ? dot - name : path.size() - name);
  return stem + std::string(ending);
}

std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

}  // namespace

std::optional<core::Error> foreign_grid(std::string_view first_bytes, const std::string& path) {
  if (first_bytes.substr(0, 2) == "\x1f\x8b"sv)
    return core::Error(path, "is packed with gzip", "gunzip " + file_name(path));
  for (const Kind& kind : kKinds) {
    if (first_bytes.substr(0, kind.begins.size()) != kind.begins) continue;
    const std::string what = "is " + std::string(kind.name) + ", not a grid that is read here";
    if (kind.options == "unzip") return core::Error(path, what, "unzip " + file_name(path));
    // Never onto itself: a GeoTIFF may well be called hill.asc.
    std::string target = renamed(path, ".asc");
    if (target == file_name(path)) target = renamed(path, "_grid.asc");
    return core::Error(
        path, what,
        "gdal_translate -of AAIGrid " + std::string(kind.options) + file_name(path) + " " + target);
  }
  return std::nullopt;
}

}  // namespace woodlouse::elevation
