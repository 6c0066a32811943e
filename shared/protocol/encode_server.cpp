#include <cassert>

#include "shared/json/object_text.h"
#include "shared/protocol/codec.h"

namespace woodlouse::protocol {
namespace {

std::string line_of(const Hello& hello) {
  json::ObjectText text("hello");
  text.integer("protocol", hello.protocol).integer("behavior", hello.behavior);
  text.text("server", hello.server).text("session", hello.session);
  text.array("rooms", hello.rooms, json::append_string)
      .array("features", hello.features, json::append_string);
  text.object("limits", [&](json::ObjectText& limits) {
    limits.integer("line", hello.limits.line).integer("depth", hello.limits.depth);
    limits.integer("messages_per_s", hello.limits.messages_per_s).integer("burst", hello.limits.burst);
    limits.integer("outbox_bytes", hello.limits.outbox_bytes)
        .integer("handshake_s", hello.limits.handshake_s);
    limits.integer("idle_s", hello.limits.idle_s).integer("per_address", hello.limits.per_address);
    limits.integer("per_room", hello.limits.per_room);
  });
  return text.line();
}

std::string line_of(const Welcome& welcome) {
  json::ObjectText text("welcome");
  text.integer("id", welcome.id).text("resume_token", welcome.resume_token).text("room", welcome.room);
  text.integer("tick", welcome.tick)
      .integer("tick_hz", welcome.tick_hz)
      .integer("state_hz", welcome.state_hz);
  text.array("fields", welcome.fields,
             [](std::string& out, Column column) { json::append_string(out, to_text(column)); });
  text.array("quantum", welcome.fields, [&](std::string& out, Column column) {
    json::append_double(out, welcome.format == Format::kExact ? 1.0 : quantum(column));
  });
  text.text("format", to_text(welcome.format));
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
    physics.text("equations", state::to_text(welcome.physics.equations));
    physics.text("method", state::to_text(welcome.physics.method));
    physics.text("contact", state::to_text(welcome.physics.contact));
    physics.text("edges", state::to_text(welcome.physics.edges));
  });
  text.text("mode", welcome.mode);
  text.objects("players", welcome.players, [](json::ObjectText& entry, const PlayerEntry& player) {
    entry.integer("id", player.id).text("name", player.name).text("role", to_text(player.role));
  });
  return text.line();
}

std::string line_of(const Frame&) {
  assert(false && "frames are encoded once per room, not per message");
  return {};
}

/// Every field of the louse; pairs where the frames' columns are single.
void append_exact(json::ObjectText& you, const ExactState& exact) {
  const state::Louse& louse = exact.louse;
  you.integer("tick", exact.tick).integer("id", louse.id);
  you.number("x", louse.position.x).number("y", louse.position.y);
  you.number("vx", louse.velocity.x).number("vy", louse.velocity.y);
  you.pair("heading", louse.heading).pair("thrust", louse.thrust);
  you.integer("thrust_kind", static_cast<std::uint32_t>(louse.thrust_kind));
  you.integer("thrust_ticks", louse.thrust_ticks).integer("phase", static_cast<std::uint32_t>(louse.phase));
  you.number("flight_z", louse.flight_z).number("flight_vz", louse.flight_vz);
  you.number("distance", louse.distance);
}

std::string line_of(const Ack& ack) {
  json::ObjectText text("ack");
  text.integer("seq", ack.seq).integer("tick", ack.tick).integer("margin_us", ack.margin_us);
  text.boolean("late", ack.late).boolean("dropped", ack.dropped).boolean("clamped", ack.clamped);
  if (ack.you) {
    text.object("you", [&](json::ObjectText& you) { append_exact(you, *ack.you); });
  }
  return text.line();
}

std::string line_of(const Event& event) {
  json::ObjectText text("event");
  text.integer("n", event.n).integer("tick", event.tick).text("kind", to_text(event.kind));
  text.integer("id", event.id).text("name", event.name);
  if (event.kind == EventKind::kJoined) text.text("role", to_text(event.role));
  if (event.kind == EventKind::kChat) text.text("text", event.text);
  return text.line();
}

std::string line_of(const Notice& notice) {
  return json::ObjectText("notice").text("code", notice.code).text("text", notice.text).line();
}

std::string line_of(const ErrorMessage& error) {
  json::ObjectText text("error");
  text.text("code", error.code).text("text", error.text).boolean("fatal", error.fatal);
  if (error.retry_after_ms) text.integer("retry_after_ms", *error.retry_after_ms);
  return text.line();
}

std::string line_of(const Bye& bye) {
  json::ObjectText text("bye");
  text.text("code", bye.code).text("text", bye.text).boolean("resumable", bye.resumable);
  return text.line();
}

std::string line_of(const Rooms& rooms) {
  json::ObjectText text("rooms");
  text.objects("rooms", rooms.rooms, [](json::ObjectText& entry, const RoomEntry& room) {
    entry.text("name", room.name).text("map", room.map);
    entry.integer("players", room.players).integer("bots", room.bots).integer("spectators", room.spectators);
  });
  return text.line();
}

/// {origin, spacing, columns, rows, heights: row by row from the south, each from west to east}
void append_knots(json::ObjectText& knots, const terrain::HeightGrid& grid) {
  knots.pair("origin", {grid.x_origin, grid.y_origin}).pair("spacing", {grid.dx, grid.dy});
  knots.integer("columns", grid.columns).integer("rows", grid.rows);
  knots.value("heights", [&](std::string& out) { json::append_rows(out, grid.heights, grid.columns); });
}

std::string line_of(const MapMessage& map) {
  json::ObjectText text("map");
  text.text("name", map.name).hash("hash", map.hash).json("definition", map.definition);
  if (map.is_overview) text.boolean("overview", true);
  if (map.knots) text.object("knots", [&](json::ObjectText& knots) { append_knots(knots, *map.knots); });
  return text.line();
}
std::string line_of(const Ping& ping) { return json::ObjectText("ping").integer("t", ping.t).line(); }
std::string line_of(const Pong& pong) { return json::ObjectText("pong").integer("t", pong.t).line(); }

}  // namespace

std::string encode(const ServerMessage& message) {
  return std::visit([](const auto& alternative) { return line_of(alternative); }, message);
}

}  // namespace woodlouse::protocol
