// What the headers of both ESRI grids have in common (esri_ascii_grid.h, flt_header.h).
#pragma once

#include <string>
#include <string_view>

namespace woodlouse::map {

inline constexpr double kMaxHeaderCoordinate =
    1e9;  ///< of origins, either way, and of spacings [the file's unit]

/// Keys may stand in any case: the text with A to Z as a to z.
inline std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

}  // namespace woodlouse::map
