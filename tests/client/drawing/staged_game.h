// A game without a server: lice that steer at random on a real map, drawn as a client would, for tests of
// what is drawn. The same seed gives the same game.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "client/drawing/scene.h"
#include "client/play/trail.h"
#include "shared/core/random.h"
#include "shared/physics/attitude.h"
#include "shared/physics/world.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::client::testing {

inline std::shared_ptr<const terrain::Terrain> named_terrain(terrain::FunctionName name) {
  return std::make_shared<terrain::Terrain>(terrain::BicubicSpline(terrain::sample_function(name, 20.0, 10)));
}

class StagedGame {
 public:
  StagedGame(std::shared_ptr<const terrain::Terrain> terrain, std::uint32_t lice, std::uint64_t seed)
      : random_(seed), world_(terrain, {}, 1.0 / 60.0) {
    const terrain::Rectangle d = terrain->domain();
    scene_.terrain = std::move(terrain);
    scene_.map_name = "volcano";
    scene_.chat = {{"ada", "on your tail"}, {"", "bot gauss joined"}};
    for (std::uint32_t id = 1; id <= lice; ++id) {
      state::Louse louse;
      louse.id = id;
      louse.position = {d.x_min + (d.x_max - d.x_min) * (0.1 + 0.8 * random_.uniform()),
                        d.y_min + (d.y_max - d.y_min) * (0.1 + 0.8 * random_.uniform())};
      world_.insert(louse);
      LouseMark mark;
      mark.id = id;
      mark.name = "louse" + std::to_string(id);
      mark.kind = id % 3 == 0 ? LouseKind::kBot : LouseKind::kPlayer;
      mark.is_you = id == 1;
      scene_.lice.push_back(mark);
      scene_.scores.push_back({id, mark.name, mark.kind, mark.is_you, 0.0, 0.0, static_cast<int>(id)});
      trails_.emplace_back((d.x_max - d.x_min) / 200.0);
      directions_.push_back(6.3 * random_.uniform());
    }
    scene_.hud.players = static_cast<int>(lice);
    update();
  }

  /// One frame at 30 a second: two ticks, and every number of the HUD anew.
  void advance() {
    for (int tick = 0; tick < 2; ++tick) {
      for (std::size_t i = 0; i < scene_.lice.size(); ++i) {
        if (random_.uniform() > 0.03) continue;
        directions_[i] += 2.5 * (random_.uniform() - 0.5);
        const core::Vec2 push{0.9 * std::cos(directions_[i]), 0.9 * std::sin(directions_[i])};
        world_.set_thrust(scene_.lice[i].id, {state::ThrustKind::kMapVector, push}, 40);
      }
      world_.step();
    }
    update();
  }

  [[nodiscard]] Scene& scene() { return scene_; }

 private:
  void update() {
    for (std::size_t i = 0; i < scene_.lice.size(); ++i) {
      const state::Louse& louse = *world_.find(scene_.lice[i].id);
      const terrain::SurfaceSample s = scene_.terrain->sample(louse.position.x, louse.position.y);
      LouseMark& mark = scene_.lice[i];
      mark.position = louse.position;
      mark.heading = mark.ahead = louse.heading;
      mark.attitude = physics::attitude(louse.heading, {s.zx, s.zy});
      mark.speed = std::hypot(louse.velocity.x, louse.velocity.y);
      trails_[i].add(louse.position);
      mark.trail = trails_[i].points();
      scene_.scores[i].distance = louse.distance;
      scene_.scores[i].speed = mark.speed;
      if (!mark.is_you) continue;
      scene_.hud.speed = mark.speed;
      scene_.hud.slope_degrees = 57.3 * std::atan(s.zx * louse.heading.x + s.zy * louse.heading.y);
      scene_.hud.distance = louse.distance;
      scene_.hud.height = s.z;
      scene_.hud.push_seconds = louse.thrust_ticks / 60.0;
      scene_.hud.thrust = louse.thrust_ticks > 0 ? 0.9 : 0.0;
      scene_.hud.rtt_ms = 20.0 + 3.0 * random_.uniform();
      scene_.hud.tick_hz = 60.0;
      scene_.hud.fps = 30.0;
    }
  }

  core::Random random_;
  physics::World world_;
  Scene scene_;
  std::vector<Trail> trails_;
  std::vector<double> directions_;
};

}  // namespace woodlouse::client::testing
