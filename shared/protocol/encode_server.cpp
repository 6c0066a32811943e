#include <cassert>

#include "shared/core/stable_hash.h"
#include "shared/json/object_text.h"
#include "shared/protocol/codec.h"

namespace woodlouse::protocol {
namespace {

/// [[south row, west to east], ..., [north row]]
std::string rows_of(const Overview& overview) {
  std::string out = "[";
  for (std::size_t k = 0; k < overview.heights.size(); ++k) {
    out += k % overview.columns != 0 ? "," : k == 0 ? "[" : "],[";
    json::append_double(out, overview.heights[k]);
  }
  return out + "]]";
}

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
  return std::move(text).line();
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
    map.text("name", welcome.map_name).text("hash", core::to_hex(welcome.map_hash));
    map.array("extent", welcome.extent, json::append_double).integer("bytes", welcome.map_bytes);
  });
  text.object("physics", [&](json::ObjectText& physics) {
    physics.number("gravity", welcome.physics.gravity).number("drag", welcome.physics.drag);
    physics.number("friction", welcome.physics.friction).number("thrust_max", welcome.physics.thrust_max);
    physics.number("edge_restitution", welcome.physics.edge_restitution);
  });
  text.text("mode", welcome.mode);
  text.array("players", welcome.players, [](std::string& out, const PlayerEntry& player) {
    json::append_integer(out += "{\"id\":", player.id);
    json::append_string(out += ",\"name\":", player.name);
    json::append_string(out += ",\"role\":", to_text(player.role));
    out += '}';
  });
  return std::move(text).line();
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
  return std::move(text).line();
}

std::string line_of(const Event& event) {
  json::ObjectText text("event");
  text.integer("n", event.n).integer("tick", event.tick).text("kind", to_text(event.kind));
  text.integer("id", event.id).text("name", event.name);
  if (event.kind == EventKind::kJoined) text.text("role", to_text(event.role));
  if (event.kind == EventKind::kChat) text.text("text", event.text);
  return std::move(text).line();
}

std::string line_of(const Notice& notice) {
  return std::move(json::ObjectText("notice").text("code", notice.code).text("text", notice.text)).line();
}

std::string line_of(const ErrorMessage& error) {
  json::ObjectText text("error");
  text.text("code", error.code).text("text", error.text).boolean("fatal", error.fatal);
  if (error.retry_after_ms) text.integer("retry_after_ms", *error.retry_after_ms);
  return std::move(text).line();
}

std::string line_of(const Bye& bye) {
  json::ObjectText text("bye");
  text.text("code", bye.code).text("text", bye.text).boolean("resumable", bye.resumable);
  return std::move(text).line();
}

std::string line_of(const Rooms& rooms) {
  json::ObjectText text("rooms");
  text.array("rooms", rooms.rooms, [](std::string& out, const RoomEntry& room) {
    json::append_string(out += "{\"name\":", room.name);
    json::append_string(out += ",\"map\":", room.map);
    json::append_integer(out += ",\"players\":", room.players);
    json::append_integer(out += ",\"bots\":", room.bots);
    json::append_integer(out += ",\"spectators\":", room.spectators);
    out += '}';
  });
  return std::move(text).line();
}

std::string line_of(const MapMessage& map) { return encode_map(map, {}); }
std::string line_of(const Ping& ping) {
  return std::move(json::ObjectText("ping").integer("t", ping.t)).line();
}
std::string line_of(const Pong& pong) {
  return std::move(json::ObjectText("pong").integer("t", pong.t)).line();
}

}  // namespace

std::string encode(const ServerMessage& message) {
  return std::visit([](const auto& alternative) { return line_of(alternative); }, message);
}

std::string encode_map(const MapMessage& message, std::string_view knots_json) {
  json::ObjectText text("map");
  text.text("name", message.name)
      .text("hash", core::to_hex(message.hash))
      .json("definition", message.definition);
  if (!knots_json.empty()) text.json("knots", knots_json);
  if (message.overview) {
    text.boolean("overview", true).object("knots", [&](json::ObjectText& knots) {
      knots.pair("origin", message.overview->origin).pair("spacing", message.overview->spacing);
      knots.integer("columns", message.overview->columns).integer("rows", message.overview->rows);
      knots.json("heights", rows_of(*message.overview));
    });
  }
  return std::move(text).line();
}

}  // namespace woodlouse::protocol
