#include "server/room/welcome.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>
#include <variant>

#include "server/access/resume_token.h"
#include "shared/map/height_survey.h"
#include "shared/map/map_world.h"
#include "shared/map/modes_reader.h"
#include "shared/protocol/codec.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::server {

Addressee addressee_of(const Seat& seat, const RowLayout& layout) {
  const auto* occupant = std::get_if<SessionOccupant>(&seat.occupant);
  assert(occupant != nullptr && occupant->state_hz > 0);
  return {seat.louse,
          seat.name,
          seat.token ? to_text(*seat.token) : std::string(),
          layout,
          occupant->state_hz,
          occupant->channel == kByInputs ? protocol::Stream::kInputs : protocol::Stream::kFrames};
}

protocol::Welcome addressed(protocol::Welcome welcome, const Addressee& to) {
  welcome.id = to.louse;
  welcome.name = to.name;
  welcome.resume_token = to.resume_token;
  welcome.fields = to.layout.fields;
  welcome.format = to.layout.format;
  welcome.state_hz = to.state_hz;
  welcome.stream = to.stream;
  return welcome;
}

protocol::Welcome welcome_for(const RoomSettings& settings, const match::Match& game, std::size_t map_bytes) {
  const map::Map& map = game.map();
  const terrain::Rectangle& domain = map.terrain->domain();
  protocol::Welcome welcome;
  welcome.room = settings.name;
  welcome.tick = game.tick();
  welcome.tick_hz = game.settings().tick_hz;
  welcome.map_name = map.definition.name;
  welcome.map_hash = map.hash;
  welcome.extent = {domain.x_min, domain.y_min, domain.x_max, domain.y_max};
  welcome.map_bytes = map_bytes;
  welcome.view_rows = settings.limits.frame_rows;
  const state::Mode mode = game.settings().mode;
  welcome.physics = map::physics_of(map.definition, mode);
  welcome.mode = state::to_text(mode);
  if (mode != state::Mode::kRoam) welcome.rules = map::mode_text(map.definition.modes, mode);
  return welcome;
}

std::optional<std::uint32_t> wanted_state_hz(const protocol::Join& join, bool is_web) {
  if (join.state_hz || join.role != protocol::Role::kSpectator) return join.state_hz;
  const bool is_by_inputs = join.stream == protocol::Stream::kInputs;
  return is_by_inputs || join.view || is_web ? std::optional(kLookersHz) : std::nullopt;
}

std::uint32_t granted_state_hz(std::optional<std::uint32_t> wanted, std::uint32_t most) {
  std::uint32_t hz = std::min(wanted.value_or(most), most);
  while (most % hz != 0) --hz;
  return hz;
}

static_assert(map::kOverviewSide <= protocol::kMaxOverviewSide);

Line encode_map_line(const map::Map& map) {
  protocol::MapMessage message{map.definition.name, map.hash, map.canonical};
  if (const auto* function = std::get_if<map::FunctionTerrain>(&map.definition.terrain)) {
    const std::size_t side = 2 * function->grid + 1;
    message.knots = terrain::sample_grid(*map.terrain, side, side);
  } else if (const auto* tiled = std::get_if<map::TiledTerrain>(&map.definition.terrain)) {
    message.is_overview = true;
    message.knots = tiled->overview;
  }
  return Line(protocol::encode(protocol::ServerMessage(std::move(message))));
}

}  // namespace woodlouse::server
