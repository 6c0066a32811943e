// `woodlouse-server make-map`: an elevation file becomes a map that is played on.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace woodlouse::server {

struct MakeMapRequest {
  std::filesystem::path file;                ///< .asc, .grd, .flt or .hgt
  std::optional<std::filesystem::path> out;  ///< NAME.json beside the file, if not given
  /// Four numbers, west, south, east, north, in the file's own coordinates (map_crop.h). Empty: all of it.
  std::vector<double> crop;
  double scale = 1.0;  ///< 1e-6..1e6
  std::string name;    ///< empty: the file's, without its ending
  bool modes = false;  ///< a race, crumbs and a hill to hold besides roaming
};

/// Writes a map file, reads it back, and says to `out` what it has and how to play it; or what is wrong. The
/// file is never written over another. 0 it stands, 1 it does not.
int make_map_command(const MakeMapRequest& request, std::ostream& out);

}  // namespace woodlouse::server
