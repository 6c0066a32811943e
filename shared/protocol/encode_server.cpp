#include <cassert>

#include "shared/json/object_text.h"
#include "shared/protocol/ack_line.h"
#include "shared/protocol/codec.h"

namespace woodlouse::protocol {
namespace {

void append_line(std::string& out, const Hello& hello) {
  json::ObjectText text(out, "hello");
  text.integer("protocol", hello.protocol).integer("behavior", hello.behavior);
  text.text("server", hello.server).text("session", hello.session);
  text.array("rooms", hello.rooms, json::append_string)
      .array("features", hello.features, json::append_string);
  text.object("limits", [&](json::ObjectText& limits) {
    for (const LimitField& field : limit_fields()) limits.integer(field.name, hello.limits.*field.member);
  });
  if (!hello.hosts.empty()) text.array("hosts", hello.hosts, json::append_string);
  text.end_line();
}

void append_line(std::string& out, const Welcome& welcome) {
  json::ObjectText text(out, "welcome");
  text.integer("id", welcome.id).text("name", welcome.name);
  text.text("resume_token", welcome.resume_token).boolean("resumed", welcome.resumed);
  text.text("room", welcome.room);
  text.integer("tick", welcome.tick)
      .integer("tick_hz", welcome.tick_hz)
      .integer("state_hz", welcome.state_hz);
  text.array("fields", welcome.fields,
             [](std::string& names, Column column) { json::append_string(names, to_text(column)); });
  text.array("quantum", welcome.fields, [&](std::string& quanta, Column column) {
    json::append_double(quanta, welcome.format == Format::kExact ? 1.0 : quantum(column));
  });
  text.text("format", to_text(welcome.format));
  if (welcome.stream == Stream::kInputs) text.text("stream", to_text(welcome.stream));
  text.object("map", [&](json::ObjectText& map) {
    map.text("name", welcome.map_name).hash("hash", welcome.map_hash);
    map.array("extent", welcome.extent, json::append_double).integer("bytes", welcome.map_bytes);
  });
  text.object("physics", [&](json::ObjectText& physics) {
    physics.number("gravity", welcome.physics.gravity).number("drag", welcome.physics.drag);
    physics.number("friction", welcome.physics.friction).number("thrust_max", welcome.physics.thrust_max);
    physics.number("edge_restitution", welcome.physics.edge_restitution);
    physics.number("central_gravity", welcome.physics.central_gravity);
    physics.number("core_radius", welcome.physics.core_radius);
    physics.number("tolerance", welcome.physics.tolerance);
    physics.text("equations", state::to_text(welcome.physics.equations));
    physics.text("method", state::to_text(welcome.physics.method));
    physics.text("contact", state::to_text(welcome.physics.contact));
    physics.text("edges", state::to_text(welcome.physics.edges));
  });
  text.text("mode", welcome.mode);
  if (!welcome.rules.empty()) text.json("rules", welcome.rules);
  text.objects("players", welcome.players, [](json::ObjectText& entry, const PlayerEntry& player) {
    entry.integer("id", player.id).text("name", player.name).text("role", to_text(player.role));
  });
  text.integer("spectators", welcome.spectators);
  if (welcome.view_rows)
    text.object("view", [&](json::ObjectText& view) { view.integer("rows", *welcome.view_rows); });
  text.end_line();
}

void append_line(std::string&, const Frame&) {
  assert(false && "frames are encoded once per room, not per message");
}

void append_line(std::string& out, const Ack& ack) { append_ack(out, ack); }

/// What an event of the rules carries.
void add_ruling(json::ObjectText& text, const Event& event) {
  text.integer("moment", event.moment);
  const std::span<const std::string_view> names = value_names(event.kind);
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (event.values[k]) {
      text.integer(names[k], *event.values[k]);
    } else {
      text.json(names[k], "null");
    }
  }
  if (event.kind != EventKind::kRound) return;
  text.text("phase", to_text(event.phase));
  append_table(text, event.table);
}

void append_line(std::string& out, const Event& event) {
  json::ObjectText text(out, "event");
  text.integer("n", event.n).integer("tick", event.tick).text("kind", to_text(event.kind));
  text.integer("id", event.id).text("name", event.name);
  if (event.kind == EventKind::kJoined) text.text("role", to_text(event.role));
  if (event.kind == EventKind::kChat) text.text("text", event.text);
  if (is_of_rules(event.kind)) add_ruling(text, event);
  text.end_line();
}

void append_line(std::string& out, const Notice& notice) {
  json::ObjectText(out, "notice").text("code", notice.code).text("text", notice.text).end_line();
}

void append_line(std::string& out, const ErrorMessage& error) {
  json::ObjectText text(out, "error");
  text.text("code", error.code).text("text", error.text).boolean("fatal", error.fatal);
  if (error.retry_after_ms) text.integer("retry_after_ms", *error.retry_after_ms);
  if (!error.address.empty()) text.text("address", error.address);
  text.end_line();
}

void append_line(std::string& out, const Bye& bye) {
  json::ObjectText text(out, "bye");
  text.text("code", bye.code).text("text", bye.text).boolean("resumable", bye.resumable);
  if (!bye.address.empty()) text.text("address", bye.address);
  text.end_line();
}

void append_line(std::string& out, const Rooms& rooms) {
  json::ObjectText text(out, "rooms");
  text.objects("rooms", rooms.rooms, [](json::ObjectText& entry, const RoomEntry& room) {
    entry.text("name", room.name).text("map", room.map);
    entry.integer("players", room.players).integer("bots", room.bots).integer("spectators", room.spectators);
    if (!room.code.empty()) entry.text("code", room.code);
    if (!room.address.empty()) entry.text("address", room.address);
  });
  text.end_line();
}

/// {origin, spacing, columns, rows, heights: row by row from the south, each from west to east}
void append_knots(json::ObjectText& knots, const terrain::HeightGrid& grid) {
  knots.pair("origin", {grid.x_origin, grid.y_origin}).pair("spacing", {grid.dx, grid.dy});
  knots.integer("columns", grid.columns).integer("rows", grid.rows);
  knots.value("heights", [&](std::string& rows) { json::append_rows(rows, grid.heights, grid.columns); });
}

void append_line(std::string& out, const MapMessage& map) {
  json::ObjectText text(out, "map");
  text.text("name", map.name).hash("hash", map.hash).json("definition", map.definition);
  if (map.is_overview) text.boolean("overview", true);
  if (map.knots) text.object("knots", [&](json::ObjectText& knots) { append_knots(knots, *map.knots); });
  text.end_line();
}
void append_line(std::string& out, const Ping& ping) {
  json::ObjectText text(out, "ping");
  text.integer("t", ping.t);
  if (ping.hosts) text.array("hosts", *ping.hosts, json::append_string);
  text.end_line();
}
void append_line(std::string& out, const Pong& pong) {
  json::ObjectText(out, "pong").integer("t", pong.t).end_line();
}

}  // namespace

void append(std::string& out, const ServerMessage& message) {
  std::visit([&out](const auto& alternative) { append_line(out, alternative); }, message);
}

std::string encode(const ServerMessage& message) {
  std::string line;
  append(line, message);
  return line;
}

}  // namespace woodlouse::protocol
