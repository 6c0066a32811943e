// Worlds of the page's own, as many as it wants: prediction, ghosts, the laboratory.
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>

#include "shared/map/map_world.h"
#include "shared/physics/world.h"
#include "shared/state/louse_fields.h"
#include "shared/state/mode.h"
#include "web/core/answer.h"
#include "web/core/bytes.h"
#include "web/core/ground.h"

namespace woodlouse::web {
namespace {

struct OpenWorld {
  std::shared_ptr<const map::Map> map;  ///< its steps may refer to it
  physics::World world;
};

Handles<OpenWorld> worlds;

bool is_sound(const state::Louse& louse) {
  bool is_finite = true;
  for (const state::LouseField& field : state::kLouseFields)
    is_finite = is_finite && std::isfinite(field_value(louse, field));
  return is_finite && louse.phase <= state::Phase::kFlying &&
         louse.thrust_kind <= state::ThrustKind::kMapVector &&
         louse.thrust.x * louse.thrust.x + louse.thrust.y * louse.thrust.y <= 1.0;
}

}  // namespace

/// Nobody is in it. `mode`: 0 roam, 1 race, 2 forage, 3 hill, one that the map has; hz: 1 to 1000. REQUIRES a
/// map that is exact.
WOODLOUSE_EXPORT(world_open) Handle world_open(Handle on, std::uint32_t hz, std::uint32_t mode) {
  const std::shared_ptr<const map::Map>& map = ground(on);
  assert(map->detail == map::Detail::kExact && hz >= 1 && hz <= 1000 && mode < state::kModes.size());
  assert(map->definition.modes.has(state::kModes[mode]));
  return worlds.add(
      std::make_unique<OpenWorld>(OpenWorld{map, map::make_world(*map, 1.0 / hz, state::kModes[mode])}));
}

WOODLOUSE_EXPORT(world_close) void world_close(Handle handle) { worlds.close(handle); }

/// In place of the one of its id, if there is one; bit for bit as it is, where it lies in the map. False: a
/// field is none that a louse can have.
WOODLOUSE_EXPORT(world_put) bool world_put(Handle handle, const char* louse) {
  state::Louse put;
  std::memcpy(&put, bytes_at(louse, sizeof put).data(), sizeof put);
  if (!is_sound(put)) return false;
  physics::World& world = worlds.at(handle).world;
  world.erase(put.id);
  world.insert(put);
  return true;
}

/// False: there is none of that id.
WOODLOUSE_EXPORT(world_erase) bool world_erase(Handle handle, std::uint32_t id) {
  return worlds.at(handle).world.erase(id);
}

WOODLOUSE_EXPORT(world_clear) void world_clear(Handle handle) { worlds.at(handle).world.restore({}); }

/// From the next step on, for so many ticks (4294967295: until another). kind: 0 none, 1 scalar, 2 vector.
/// False: there is none of that id, or a longer thrust than 1.
WOODLOUSE_EXPORT(world_thrust)
bool world_thrust(Handle handle, std::uint32_t id, std::uint32_t kind, double x, double y,
                  std::uint32_t ticks) {
  if (kind > 2 || !(x * x + y * y <= 1.0)) return false;
  return worlds.at(handle).world.set_thrust(id, {static_cast<state::ThrustKind>(kind), {x, y}}, ticks);
}

WOODLOUSE_EXPORT(world_step) void world_step(Handle handle, std::uint32_t ticks) {
  physics::World& world = worlds.at(handle).world;
  for (std::uint32_t k = 0; k < ticks; ++k) world.step();
}

/// Where one stands, until the world's next change; null: there is none of that id.
WOODLOUSE_EXPORT(world_find) const state::Louse* world_find(Handle handle, std::uint32_t id) {
  return worlds.at(handle).world.find(id);
}

/// By ascending id, 104 bytes each (louse_fields); until the world's next change.
WOODLOUSE_EXPORT(world_lice) const state::Louse* world_lice(Handle handle) {
  return worlds.at(handle).world.lice().data();
}
WOODLOUSE_EXPORT(world_count) std::size_t world_count(Handle handle) {
  return worlds.at(handle).world.lice().size();
}

}  // namespace woodlouse::web
