#include <array>

#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"
#include "shared/protocol/decode_frame.h"
#include "shared/protocol/decode_game.h"
#include "shared/protocol/decode_map.h"
#include "shared/protocol/decode_records.h"
#include "shared/protocol/field_reader.h"
#include "shared/protocol/field_texts.h"
#include "shared/protocol/text_cleaning.h"
#include "shared/protocol/whereabouts.h"

namespace woodlouse::protocol {
namespace {

using Decoded = tl::expected<ServerMessage, DecodeError>;
using Context = FrameContext;

constexpr IntegerRange kPositiveUint32{1, 0xffff'ffff};
constexpr ByteRange kNameBytes{0, kMaxNameBytes};  // a spectator may be shown without one
constexpr ByteRange kLabelBytes{1, kMaxRoomBytes};
constexpr ByteRange kTextBytes{0, kMaxTextBytes};

void read_strings(FieldReader& reader, std::string_view name, std::vector<std::string>& out) {
  reader.array(name, "an array of strings", [&](json::Value element, std::size_t index) {
    if (element.kind() != json::Kind::kString) return reader.refuse(name, index, element, "a string");
    out.push_back(clean_text(element.text(), kMaxRoomBytes));
  });
}

constexpr std::string_view kWantsHosts = R"(an array of at most 16 texts "host:port")";
static_assert(kMaxHosts == 16);

void read_hosts(FieldReader& reader, std::vector<std::string>& hosts) {
  reader.array(
      "hosts", kWantsHosts,
      [&](json::Value element, std::size_t index) {
        const bool is_host = element.kind() == json::Kind::kString && parse_host_address(element.text());
        if (!is_host || index == kMaxHosts) return reader.refuse("hosts", index, element, kWantsHosts);
        hosts.emplace_back(element.text());
      },
      Presence::kOptional);
}

Decoded read_hello(FieldReader& reader, const Context&) {
  Hello hello;
  reader.integer("protocol", hello.protocol, {0, 0x7fff'ffff});
  reader.integer("behavior", hello.behavior, {0, 0x7fff'ffff});
  reader.cleaned_text("server", hello.server, {0, 200});
  reader.cleaned_text("session", hello.session, {0, kMaxRoomBytes});
  read_strings(reader, "rooms", hello.rooms);
  read_strings(reader, "features", hello.features);
  reader.object("limits", [&](FieldReader& limits) {
    for (const LimitField& field : limit_fields()) {
      std::uint32_t& limit = hello.limits.*field.member;
      limit = 0;
      limits.integer(field.name, limit, field.is_old ? kPositiveUint32 : kAnyUint32,
                     field.is_old ? Presence::kRequired : Presence::kOptional);
    }
  });
  read_hosts(reader, hello.hosts);
  return reader.finish<ServerMessage>(std::move(hello));
}

void read_columns(FieldReader& reader, Welcome& welcome) {
  reader.array("fields", "an array of column names", [&](json::Value element, std::size_t index) {
    const auto column =
        element.kind() == json::Kind::kString ? column_from_text(element.text()) : std::nullopt;
    if (!column) return reader.refuse("fields", index, element, "one of: " + column_names());
    if ((index == 0) != (*column == Column::kId)) {
      return reader.refuse("fields", index, element, "id in the first place and there alone");
    }
    welcome.fields.push_back(*column);
  });
}

/// The quanta are part of protocol 1: a server with others speaks something else.
void check_quanta(FieldReader& reader, const Welcome& welcome) {
  constexpr std::string_view kWants = "an array of one number per column";
  const auto value = reader.field("quantum", kWants, Presence::kRequired);
  if (!value) return;
  if (value->kind() != json::Kind::kArray || value->size() != welcome.fields.size()) {
    return reader.refuse("quantum", *value, kWants);
  }
  reader.array("quantum", kWants, [&](json::Value element, std::size_t index) {
    const double wanted = welcome.format == Format::kExact ? 1.0 : quantum(welcome.fields[index]);
    if (!element.is_number() || element.number() != wanted) {
      reader.refuse("quantum", index, element, "the column's quantum in this protocol");
    }
  });
}

void read_extent(FieldReader& reader, std::array<double, 4>& extent) {
  constexpr std::string_view kWants = "[x_min, y_min, x_max, y_max]";
  const auto value = reader.field("extent", kWants, Presence::kRequired);
  if (!value) return;
  if (value->kind() != json::Kind::kArray || value->size() != extent.size()) {
    return reader.refuse("extent", *value, kWants);
  }
  reader.array("extent", kWants, [&](json::Value element, std::size_t index) {
    if (!element.is_number()) return reader.refuse("extent", index, element, "a number");
    extent[index] = element.number();
  });
  const bool is_a_rectangle = extent[0] < extent[2] && extent[1] < extent[3];
  if (!reader.failed() && !is_a_rectangle)
    reader.refuse("extent", *value, "a rectangle with x_min < x_max, y_min < y_max");
}

Decoded read_welcome(FieldReader& reader, const Context&) {
  Welcome welcome;
  reader.integer("id", welcome.id, kAnyUint32);
  reader.cleaned_text("name", welcome.name, kNameBytes, Presence::kOptional);
  reader.cleaned_text("resume_token", welcome.resume_token, {0, kMaxTokenBytes});
  reader.boolean("resumed", welcome.resumed, Presence::kOptional);
  reader.cleaned_text("room", welcome.room, kLabelBytes);
  reader.integer("tick", welcome.tick, kAnyTick);
  reader.integer("tick_hz", welcome.tick_hz, {1, 100'000});
  reader.integer("state_hz", welcome.state_hz, {1, 100'000});
  read_columns(reader, welcome);
  reader.choice("format", welcome.format, kFormatTexts, format_from_text);
  check_quanta(reader, welcome);
  reader.choice("stream", welcome.stream, kStreamTexts, stream_from_text, Presence::kOptional);
  reader.object("map", [&](FieldReader& map) {
    map.cleaned_text("name", welcome.map_name, kLabelBytes);
    map.hash("hash", welcome.map_hash);
    read_extent(map, welcome.extent);
    map.integer("bytes", welcome.map_bytes, {0, kMaxInteger});
  });
  reader.object("physics", [&](FieldReader& physics) {
    physics.number("gravity", welcome.physics.gravity);
    physics.number("drag", welcome.physics.drag);
    physics.number("friction", welcome.physics.friction);
    physics.number("thrust_max", welcome.physics.thrust_max);
    physics.number("edge_restitution", welcome.physics.edge_restitution);
    // What an older server does not say is not there.
    constexpr Presence kNewer = Presence::kOptional;
    physics.number("central_gravity", welcome.physics.central_gravity, kNewer);
    physics.number("core_radius", welcome.physics.core_radius, kNewer);
    physics.number("tolerance", welcome.physics.tolerance, kNewer);
    physics.choice("equations", welcome.physics.equations, "exact, local_plane or as_printed",
                   state::equations_from_text, kNewer);
    physics.choice("method", welcome.physics.method, "standard, cheap, precise or false_euler",
                   state::method_from_text, kNewer);
    physics.choice("contact", welcome.physics.contact, "bilateral or unilateral", state::contact_from_text,
                   kNewer);
    physics.choice("edges", welcome.physics.edges, "walls, wrap or open", state::edges_from_text, kNewer);
  });
  reader.cleaned_text("mode", welcome.mode, kLabelBytes);
  if (const auto rules = reader.field("rules", "an object", Presence::kOptional)) {
    if (rules->kind() != json::Kind::kObject) reader.refuse("rules", *rules, "an object");
    if (!reader.failed()) welcome.rules = rules->raw();
  }
  reader.objects("players", [&](FieldReader& player) {
    PlayerEntry entry;
    player.integer("id", entry.id, kAnyUint32);
    player.cleaned_text("name", entry.name, kNameBytes);
    player.choice("role", entry.role, kRoleTexts, role_from_text);
    welcome.players.push_back(std::move(entry));
  });
  reader.integer("spectators", welcome.spectators, kAnyUint32, Presence::kOptional);
  reader.object(
      "view",
      [&](FieldReader& view) {
        view.integer("rows", welcome.view_rows.emplace(), {1, kEveryRow});
      },
      Presence::kOptional);
  return reader.finish<ServerMessage>(std::move(welcome));
}

ExactState read_exact(FieldReader& you) {
  ExactState exact;
  state::Louse& louse = exact.louse;
  you.integer("tick", exact.tick, kAnyTick);
  you.integer("id", louse.id, kPositiveUint32);
  you.number("x", louse.position.x);
  you.number("y", louse.position.y);
  you.number("vx", louse.velocity.x);
  you.number("vy", louse.velocity.y);
  you.pair("heading", louse.heading);
  you.pair("thrust", louse.thrust);
  std::uint32_t kind = 0;
  you.integer("thrust_kind", kind, {0, 2});
  louse.thrust_kind = static_cast<state::ThrustKind>(kind);
  you.integer("thrust_ticks", louse.thrust_ticks, kAnyUint32);
  std::uint32_t phase = 0;
  you.integer("phase", phase, {0, 2});
  louse.phase = static_cast<state::Phase>(phase);
  you.number("flight_z", louse.flight_z);
  you.number("flight_vz", louse.flight_vz);
  you.number("distance", louse.distance);
  return exact;
}

Decoded read_ack(FieldReader& reader, const Context&) {
  Ack ack;
  reader.integer("seq", ack.seq, kAnyUint32);
  reader.integer("tick", ack.tick, kAnyTick);
  reader.integer("margin_us", ack.margin_us, kAnyInteger);
  reader.boolean("late", ack.late);
  reader.boolean("dropped", ack.dropped);
  reader.boolean("clamped", ack.clamped);
  reader.object(
      "you", [&](FieldReader& you) { ack.you = read_exact(you); }, Presence::kOptional);
  return reader.finish<ServerMessage>(ack);
}

/// A kind of a later version is no fault: unknown_type lets a client pass over it.
void read_kind(FieldReader& reader, EventKind& out) {
  constexpr std::string_view kWants = R"("joined", "left", "chat", "respawned" or one of the rules')";
  const auto value = reader.field("kind", kWants, Presence::kRequired);
  if (!value) return;
  if (value->kind() != json::Kind::kString) return reader.refuse("kind", *value, kWants);
  const auto kind = event_kind_from_text(value->text());
  if (!kind) {
    return reader.fail(code::kUnknownType,
                       "event.kind is " + description(*value) + "; known are " + std::string(kWants));
  }
  out = *kind;
}

Decoded read_event(FieldReader& reader, const Context&) {
  Event event;
  reader.integer("n", event.n, {1, kMaxInteger});
  reader.integer("tick", event.tick, kAnyTick);
  read_kind(reader, event.kind);
  reader.integer("id", event.id, kAnyUint32);
  reader.cleaned_text("name", event.name, kNameBytes);
  if (event.kind == EventKind::kJoined) reader.choice("role", event.role, kRoleTexts, role_from_text);
  if (event.kind == EventKind::kChat) reader.cleaned_text("text", event.text, {1, kMaxChatBytes});
  if (is_of_rules(event.kind)) read_ruling(reader, event);
  return reader.finish<ServerMessage>(std::move(event));
}

Decoded read_notice(FieldReader& reader, const Context&) {
  Notice notice;
  reader.cleaned_text("code", notice.code, kLabelBytes);
  reader.cleaned_text("text", notice.text, kTextBytes);
  return reader.finish<ServerMessage>(std::move(notice));
}

/// Whoever follows it judges its form: who only shows what was said need not care.
void read_address(FieldReader& reader, std::string& address) {
  reader.key_text("address", address, kMaxAddressBytes, Presence::kOptional);
}

Decoded read_error(FieldReader& reader, const Context&) {
  ErrorMessage error;
  reader.cleaned_text("code", error.code, kLabelBytes);
  reader.cleaned_text("text", error.text, kTextBytes);
  reader.boolean("fatal", error.fatal);
  reader.integer("retry_after_ms", error.retry_after_ms, kAnyUint32);
  read_address(reader, error.address);
  return reader.finish<ServerMessage>(std::move(error));
}

Decoded read_bye(FieldReader& reader, const Context&) {
  Bye bye;
  reader.cleaned_text("code", bye.code, kLabelBytes);
  reader.cleaned_text("text", bye.text, kTextBytes);
  reader.boolean("resumable", bye.resumable);
  read_address(reader, bye.address);
  return reader.finish<ServerMessage>(std::move(bye));
}

Decoded read_rooms(FieldReader& reader, const Context&) {
  Rooms rooms;
  reader.objects("rooms", [&](FieldReader& room) {
    RoomEntry entry;
    room.cleaned_text("name", entry.name, kLabelBytes);
    room.cleaned_text("map", entry.map, kLabelBytes);
    room.integer("players", entry.players, kAnyUint32);
    room.integer("bots", entry.bots, kAnyUint32);
    room.integer("spectators", entry.spectators, kAnyUint32);
    room.key_text("code", entry.code, kLabelBytes.high, Presence::kOptional);
    read_address(room, entry.address);
    rooms.rooms.push_back(std::move(entry));
  });
  return reader.finish<ServerMessage>(std::move(rooms));
}

Decoded read_map_message(FieldReader& reader, const Context&) {
  MapMessage map;
  read_map(reader, map);
  return reader.finish<ServerMessage>(std::move(map));
}

Decoded read_ping(FieldReader& reader, const Context&) {
  Ping ping;
  reader.integer("t", ping.t, kAnyInteger);
  if (reader.field("hosts", kWantsHosts, Presence::kOptional)) read_hosts(reader, ping.hosts.emplace());
  return reader.finish<ServerMessage>(std::move(ping));
}

Decoded read_pong(FieldReader& reader, const Context&) {
  Pong pong;
  reader.integer("t", pong.t, kAnyInteger);
  return reader.finish<ServerMessage>(pong);
}

using Read = Decoded (*)(FieldReader&, const Context&);

constexpr std::array<std::pair<std::string_view, Read>, 15> kTypes = {{
    {"hello", read_hello},
    {"welcome", read_welcome},
    {"key", read_key},
    {"delta", read_delta},
    {"ack", read_ack},
    {"event", read_event},
    {"notice", read_notice},
    {"error", read_error},
    {"bye", read_bye},
    {"rooms", read_rooms},
    {"map", read_map_message},
    {"ping", read_ping},
    {"pong", read_pong},
    {"records", read_records},
    {"ghost", read_ghost},
}};

}  // namespace

Decoded decode_server(std::string_view line, const std::vector<Column>& fields, Format format) {
  const auto document = parse_object(line);
  if (!document) return tl::unexpected(document.error());
  const auto type = read_type(*document, kTypes);
  if (!type) return tl::unexpected(type.error());
  FieldReader reader(document->root(), std::string((*type)->first));
  return (*type)->second(reader, Context{fields, format});
}

}  // namespace woodlouse::protocol
