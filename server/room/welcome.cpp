#include "server/room/welcome.h"

#include <algorithm>

#include "server/room/resume_token.h"
#include "shared/map/map_world.h"
#include "shared/map/modes_reader.h"

namespace woodlouse::server {

protocol::Welcome welcome_for(const Seat& seat, const RowLayout& layout, const RoomSettings& settings,
                              const match::Match& game, std::size_t map_bytes) {
  const map::Map& map = game.map();
  const terrain::Rectangle& domain = map.terrain->domain();
  protocol::Welcome welcome;
  welcome.id = seat.louse;
  welcome.name = seat.name;
  if (seat.token) welcome.resume_token = to_text(*seat.token);
  welcome.room = settings.name;
  welcome.tick = game.tick();
  welcome.tick_hz = game.settings().tick_hz;
  welcome.fields = layout.fields;
  welcome.format = layout.format;
  welcome.map_name = map.definition.name;
  welcome.map_hash = map.hash;
  welcome.extent = {domain.x_min, domain.y_min, domain.x_max, domain.y_max};
  welcome.map_bytes = map_bytes;
  const state::Mode mode = game.settings().mode;
  welcome.physics = map::physics_of(map.definition, mode);
  welcome.mode = state::to_text(mode);
  if (mode != state::Mode::kRoam) welcome.rules = map::mode_text(map.definition.modes, mode);
  return welcome;
}

std::uint32_t granted_state_hz(std::optional<std::uint32_t> wanted, std::uint32_t most) {
  std::uint32_t hz = std::min(wanted.value_or(most), most);
  while (most % hz != 0) --hz;
  return hz;
}

}  // namespace woodlouse::server
