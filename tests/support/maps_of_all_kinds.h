// A map of each kind that a game may be on.
#pragma once

#include <catch2/catch.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "shared/core/error.h"
#include "shared/core/joined.h"
#include "shared/map/map_file.h"
#include "tests/support/big_map_files.h"

namespace woodlouse::tests {

using Maps = std::vector<std::shared_ptr<const map::Map>>;

inline void add(Maps& maps, core::Expected<std::shared_ptr<const map::Map>> map) {
  if (!map) FAIL(map.error().text());
  maps.push_back(std::move(*map));
}

/// All that are shipped, and the grounds and rules that none of these has.
inline Maps maps_of_all_kinds(const BigMapFiles& big) {
  Maps maps;
  for (const auto& entry : std::filesystem::directory_iterator(WOODLOUSE_SOURCE_DIR "/maps")) {
    if (entry.path().extension() == ".json") add(maps, map::load_map(entry.path()));
  }
  REQUIRE(maps.size() >= 10);
  add(maps, map::load_map(big.map(R"(,"storage":"tiles")")));
  for (
      const std::string rest :
      {R"("surface":"function","physics":{"friction":0.3,"thrust_max":9})",
       R"("physics":{"friction":0.3,"thrust_max":9,"method":"cheap"})",
       R"("physics":{"friction":0.3,"thrust_max":9,"method":"precise"})",
       R"("physics":{"friction":0.3,"thrust_max":9,"contact":"unilateral"})",
       R"("surface":"blended","physics":{"friction":0.3,"thrust_max":9,"equations":"local_plane","method":"false_euler"})"}) {
    add(maps, map::parse_map(
                  core::joined({R"({"name":"small","terrain":{"function":"wavy_pot","grid":6},)", rest, "}"}),
                  "small.json", {}));
  }
  // Whoever does not drive stands there, held or not.
  for (const std::string rest : {R"({"friction":0.3,"thrust_max":9})", R"({"thrust_max":9})"}) {
    add(maps, map::parse_map(
                  core::joined({R"({"name":"level","terrain":{"heights":[[0,0,0,0],[0,0,0,0],[0,0,0,0],)",
                                R"([0,0,0,0]],"spacing":10},"physics":)", rest, "}"}),
                  "level.json", {}));
  }
  return maps;
}

}  // namespace woodlouse::tests
