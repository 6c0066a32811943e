#include "server/room/room_map.h"

#include <string>
#include <utility>
#include <variant>

#include "shared/map/height_survey.h"
#include "shared/protocol/codec.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::server {
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
