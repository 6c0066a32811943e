#include "server/room/room_map.h"

#include <string>
#include <variant>

#include "shared/json/text.h"
#include "shared/map/height_survey.h"
#include "shared/protocol/codec.h"
#include "shared/terrain/terrain.h"

namespace woodlouse::server {
namespace {

/// {origin, spacing, columns, rows, heights: row by row from the south, each from west to east}
std::string encode_knots(const terrain::HeightGrid& grid) {
  std::string out = R"({"origin":[)";
  json::append_double(out, grid.x_origin);
  out += ',';
  json::append_double(out, grid.y_origin);
  out += R"(],"spacing":[)";
  json::append_double(out, grid.dx);
  out += ',';
  json::append_double(out, grid.dy);
  out += R"(],"columns":)" + std::to_string(grid.columns) + R"(,"rows":)" + std::to_string(grid.rows) +
         R"(,"heights":[)";
  for (std::size_t j = 0; j < grid.rows; ++j) {
    out += j == 0 ? "[" : ",[";
    for (std::size_t i = 0; i < grid.columns; ++i) {
      if (i > 0) out += ',';
      json::append_double(out, grid.at(i, j));
    }
    out += ']';
  }
  return out + "]}";
}

static_assert(map::kOverviewSide <= protocol::kMaxOverviewSide);

protocol::Overview overview_of(const terrain::HeightGrid& grid) {
  return {{grid.x_origin, grid.y_origin}, {grid.dx, grid.dy}, grid.columns, grid.rows, grid.heights};
}

}  // namespace

Line encode_map_line(const map::Map& map) {
  std::string knots;
  if (const auto* function = std::get_if<map::FunctionTerrain>(&map.definition.terrain)) {
    const std::size_t side = 2 * function->grid + 1;
    knots = encode_knots(terrain::sample_grid(*map.terrain, side, side));
  }
  protocol::MapMessage message{map.definition.name, map.hash, map.canonical};
  if (const auto* tiled = std::get_if<map::TiledTerrain>(&map.definition.terrain)) {
    message.overview = overview_of(tiled->overview);
  }
  return std::make_shared<const std::string>(protocol::encode_map(message, knots));
}

}  // namespace woodlouse::server
