// Every map of maps/, loaded once: what is drawn has to hold for all of them.
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "client/drawing/scene.h"
#include "shared/map/map_file.h"

namespace woodlouse::client::testing {

inline const std::vector<std::shared_ptr<const map::Map>>& shipped_maps() {
  static const auto maps = [] {
    std::vector<std::shared_ptr<const map::Map>> loaded;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(WOODLOUSE_SOURCE_DIR) + "/maps")) {
      if (entry.path().extension() != ".json") continue;
      auto one = map::load_map(entry.path().string());
      REQUIRE(one);
      loaded.push_back(std::move(*one));
    }
    REQUIRE(loaded.size() > 10);
    return loaded;
  }();
  return maps;
}

/// The map as a client shows it, without anybody.
inline Scene scene_of(const map::Map& map, Look look, View view) {
  Scene scene;
  scene.terrain = map.terrain;
  const state::Parameters& physics = map.definition.physics;
  scene.landmarks = {physics.edges, physics.central_gravity > 0.0 ? physics.core_radius : 0.0};
  scene.look = look;
  scene.view = view;
  scene.labels = false;
  return scene;
}

}  // namespace woodlouse::client::testing
