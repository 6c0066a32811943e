#include "shared/protocol/decode_map.h"

#include <array>
#include <utility>

#include "shared/protocol/codes.h"
#include "shared/protocol/field_texts.h"
#include "shared/protocol/line_object.h"

namespace woodlouse::protocol {
namespace {

constexpr ByteRange kMapNameBytes{1, kMaxRoomBytes};

void read_overview(FieldReader& knots, terrain::HeightGrid& overview) {
  constexpr IntegerRange kSide{4, static_cast<std::int64_t>(kMaxOverviewSide)};
  core::Vec2 origin;
  core::Vec2 spacing;
  knots.pair("origin", origin);
  knots.pair("spacing", spacing);
  if (!knots.failed() && !(spacing.x > 0.0 && spacing.y > 0.0)) {
    knots.fail(code::kBadField, "map.knots.spacing: it must be two numbers above 0");
  }
  overview.x_origin = origin.x;
  overview.y_origin = origin.y;
  overview.dx = spacing.x;
  overview.dy = spacing.y;
  knots.integer("columns", overview.columns, kSide);
  knots.integer("rows", overview.rows, kSide);
  knots.array("heights", "an array of rows", [&](json::Value row, std::size_t index) {
    const auto refuse = [&] {
      knots.refuse("heights", index, row, "one of `rows` arrays of `columns` numbers");
      return false;
    };
    if (row.kind() != json::Kind::kArray || row.size() != overview.columns || index >= overview.rows) {
      static_cast<void>(refuse());
      return;
    }
    row.for_each([&](json::Value height) {
      if (!height.is_number()) return refuse();
      overview.heights.push_back(height.number());
      return true;
    });
  });
  if (!knots.failed() && overview.heights.size() != overview.columns * overview.rows) {
    knots.fail(code::kBadField, "map.knots.heights: it must hold `rows` arrays");
  }
}

}  // namespace

void read_map(FieldReader& reader, MapMessage& map) {
  reader.cleaned_text("name", map.name, kMapNameBytes);
  reader.hash("hash", map.hash);
  if (const auto definition = reader.field("definition", "an object", Presence::kRequired)) {
    if (definition->kind() != json::Kind::kObject) reader.refuse("definition", *definition, "an object");
    if (!reader.failed()) map.definition = definition->raw();  // the hash is taken over these bytes
  }
  if (reader.field("overview", "true or false", Presence::kOptional))
    reader.boolean("overview", map.is_overview);
  if (map.is_overview)
    reader.object("knots", [&](FieldReader& knots) { read_overview(knots, map.knots.emplace()); });
}

tl::expected<MapMessage, DecodeError> decode_map(std::string_view line) {
  const auto document = parse_object(line);
  if (!document) return tl::unexpected(document.error());
  constexpr std::array<std::pair<std::string_view, bool>, 1> kTypes = {{{"map", true}}};
  if (const auto type = read_type(*document, kTypes); !type) return tl::unexpected(type.error());
  FieldReader reader(document->root(), "map");
  MapMessage map;
  read_map(reader, map);
  return reader.finish<MapMessage>(std::move(map));
}

}  // namespace woodlouse::protocol
