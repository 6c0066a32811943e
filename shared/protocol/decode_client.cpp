#include <algorithm>
#include <array>

#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"
#include "shared/protocol/decode_records.h"
#include "shared/protocol/field_reader.h"
#include "shared/protocol/field_texts.h"
#include "shared/protocol/input_line.h"

namespace woodlouse::protocol {
namespace {

using Decoded = tl::expected<ClientMessage, DecodeError>;

void take(const state::RoundedThrust& rounded, Input& input) {
  input.thrust = rounded.thrust;
  input.clamped = rounded.clamped;
}

void read_thrust(FieldReader& reader, Input& input) {
  constexpr std::string_view kWants =
      "a number from -1 to 1 (along the heading) or a pair [x, y] of length at most 1";
  const auto value = reader.field("thrust", kWants, Presence::kRequired);
  if (!value) return;
  if (value->is_number()) return take(state::rounded_along_heading(value->number()), input);
  if (value->kind() != json::Kind::kArray || value->size() != 2)
    return reader.refuse("thrust", *value, kWants);
  core::Vec2 pair;
  reader.pair("thrust", pair);
  take(state::rounded_map_vector(pair), input);
}

void append_column(FieldReader& reader, json::Value element, std::size_t index,
                   std::vector<Column>& columns) {
  const auto column = element.kind() == json::Kind::kString ? column_from_text(element.text()) : std::nullopt;
  if (!column) return reader.refuse("fields", index, element, "one of: " + column_names());
  if (std::find(columns.begin(), columns.end(), *column) != columns.end()) {
    return reader.refuse("fields", index, element, "named once");
  }
  columns.push_back(*column);
}

void read_fields(FieldReader& reader, std::vector<Column>& columns) {
  constexpr std::string_view kWants = "\"all\" or an array of column names";
  columns = default_columns();
  const auto value = reader.field("fields", kWants, Presence::kOptional);
  if (!value) return;
  if (value->kind() == json::Kind::kString && value->text() == "all") {
    columns = all_columns();
    return;
  }
  if (value->kind() != json::Kind::kArray) return reader.refuse("fields", *value, kWants);
  columns.clear();
  reader.array("fields", kWants, [&](json::Value element, std::size_t index) {
    append_column(reader, element, index, columns);
  });
  const auto id = std::find(columns.begin(), columns.end(), Column::kId);
  if (id != columns.end()) columns.erase(id);
  columns.insert(columns.begin(), Column::kId);
}

/// true, or the token of an earlier welcome. A token asks for the next one too.
void read_resume(FieldReader& reader, Join& join) {
  constexpr std::string_view kWants = "true, false or the resume_token of a welcome";
  const auto value = reader.field("resume", kWants, Presence::kOptional);
  if (!value) return;
  if (value->kind() == json::Kind::kBoolean) {
    reader.boolean("resume", join.may_resume);
  } else if (value->kind() == json::Kind::kString) {
    reader.cleaned_text("resume", join.resume, {1, kMaxTokenBytes});
    join.may_resume = true;
  } else {
    reader.refuse("resume", *value, kWants);
  }
}

void read_view(FieldReader& reader, View& view) {
  constexpr std::string_view kLouse = "the id of a louse; x and y say another place";
  const bool has_place = reader.field("x", "a number", Presence::kOptional).has_value() ||
                         reader.field("y", "a number", Presence::kOptional).has_value();
  if (has_place) {
    view.place.emplace();
    reader.number("x", view.place->x);
    reader.number("y", view.place->y);
    if (const auto louse = reader.field("louse", kLouse, Presence::kOptional))
      reader.refuse("louse", *louse, "left out where x and y say the place");
  }
  reader.integer("louse", view.louse, {1, 0xffff'ffff});
  if (const auto radius = reader.field("radius", "a number above 0", Presence::kOptional)) {
    view.radius.emplace();
    reader.number("radius", *view.radius);
    if (!reader.failed() && !(*view.radius > 0.0)) reader.refuse("radius", *radius, "a number above 0");
  }
  reader.integer("rows", view.rows, {1, kEveryRow});
}

Decoded read_look(FieldReader& reader) {
  Look look;
  read_view(reader, look.view);
  return reader.finish<ClientMessage>(look);
}

void read_its_view(FieldReader& reader, Join& join) {
  reader.object(
      "view", [&](FieldReader& inner) { read_view(inner, join.view.emplace()); }, Presence::kOptional);
}

/// No error shows what it was.
void read_token(FieldReader& reader, std::string& token) {
  constexpr std::string_view kWants = "a password of the server, of 1 to 256 bytes";
  const auto value = reader.field("token", kWants, Presence::kOptional);
  if (!value) return;
  if (value->kind() != json::Kind::kString || value->text().empty() ||
      value->text().size() > kMaxPasswordBytes)
    return reader.fail(code::kBadField, "join.token must be " + std::string(kWants));
  token = value->text();
}

Decoded read_join(FieldReader& reader) {
  Join join;
  reader.integer("protocol", join.protocol, kAnyUint32);
  if (!reader.failed() && join.protocol != kProtocolVersion) {
    reader.fail(code::kBadProtocol, "join.protocol is " + std::to_string(join.protocol) +
                                        "; this server speaks " + std::to_string(kProtocolVersion));
  }
  reader.choice("role", join.role, kRoleTexts, role_from_text, Presence::kOptional);
  reader.cleaned_text("name", join.name, {1, kMaxNameBytes});
  reader.key_text("room", join.room, kMaxRoomBytes, Presence::kOptional);
  read_fields(reader, join.fields);
  reader.choice("format", join.format, kFormatTexts, format_from_text, Presence::kOptional);
  reader.integer("state_hz", join.state_hz, {1, kMaxStateHz});
  reader.choice("stream", join.stream, kStreamTexts, stream_from_text, Presence::kOptional);
  if (!reader.failed() && join.stream == Stream::kInputs && join.role != Role::kSpectator)
    reader.fail(code::kBadField,
                "join.stream is \"inputs\", which is for the role \"spectator\": who plays is "
                "shown frames");
  read_resume(reader, join);
  read_its_view(reader, join);
  read_token(reader, join.token);
  return reader.finish<ClientMessage>(std::move(join));
}

Decoded read_input(FieldReader& reader) {
  Input input;
  reader.integer("seq", input.seq, kAnyUint32);
  read_thrust(reader, input);
  reader.integer("ticks", input.ticks, {1, kMaxThrustTicks});
  reader.integer("tick", input.tick, kAnyTick);
  return reader.finish<ClientMessage>(input);
}

Decoded read_chat(FieldReader& reader) {
  Chat chat;
  reader.cleaned_text("text", chat.text, {1, kMaxChatBytes});
  return reader.finish<ClientMessage>(std::move(chat));
}

/// ping and pong.
template <typename Message>
Decoded read_time(FieldReader& reader) {
  Message message;
  reader.integer("t", message.t, kAnyInteger);
  return reader.finish<ClientMessage>(message);
}

/// A message without fields.
template <typename Message>
Decoded read_bare(FieldReader& reader) {
  return reader.finish<ClientMessage>(Message{});
}

Decoded read_respawn(FieldReader& reader) {
  constexpr std::string_view kWants = R"("spawn" or "gate")";
  Respawn respawn;
  reader.choice(
      "at", respawn.at_gate, kWants,
      [](std::string_view text) -> std::optional<bool> {
        return text == "gate" ? std::optional(true) : text == "spawn" ? std::optional(false) : std::nullopt;
      },
      Presence::kOptional);
  return reader.finish<ClientMessage>(respawn);
}

Decoded read_list(FieldReader& reader) {
  List list;
  reader.boolean("watch", list.watch, Presence::kOptional);
  return reader.finish<ClientMessage>(list);
}

Decoded read_list_records(FieldReader& reader) {
  ListRecords list;
  reader.choice("board", list.board, kBoardTexts, board_from_text, Presence::kOptional);
  return reader.finish<ClientMessage>(list);
}

Decoded read_get_ghost(FieldReader& reader) {
  GetGhost get;
  reader.choice("board", get.board, kBoardTexts, board_from_text, Presence::kOptional);
  reader.integer("rank", get.rank, {1, kMostRank}, Presence::kOptional);
  return reader.finish<ClientMessage>(get);
}

Decoded read_moderate(FieldReader& reader) {
  Moderate moderate;
  reader.choice("action", moderate.action, R"("kick", "mute", "unmute" or "say")",
                [](std::string_view text) -> std::optional<std::string> {
                  for (const char* action : {"kick", "mute", "unmute", "say"})
                    if (text == action) return std::string(text);
                  return std::nullopt;
                });
  const bool says = moderate.action == "say";
  reader.key_text("who", moderate.who, kMaxNameBytes, says ? Presence::kOptional : Presence::kRequired);
  if (says) reader.cleaned_text("text", moderate.text, {1, kMaxChatBytes});
  reader.integer("seconds", moderate.seconds, {1, kMaxModerateSeconds});
  return reader.finish<ClientMessage>(std::move(moderate));
}

using Read = Decoded (*)(FieldReader&);

constexpr std::array<std::pair<std::string_view, Read>, 15> kTypes = {{
    {"join", read_join},
    {"input", read_input},
    {"chat", read_chat},
    {"list", read_list},
    {"get_map", read_bare<GetMap>},
    {"resync", read_bare<Resync>},
    {"respawn", read_respawn},
    {"skip", read_bare<Skip>},
    {"view", read_look},
    {"leave", read_bare<Leave>},
    {"ping", read_time<Ping>},
    {"pong", read_time<Pong>},
    {"list_records", read_list_records},
    {"get_ghost", read_get_ghost},
    {"moderate", read_moderate},
}};

}  // namespace

Decoded decode_client(std::string_view line) {
  if (const std::optional<Input> input = scan_input(line))
    return Decoded(tl::in_place, std::in_place_type<Input>, *input);
  const auto document = parse_object(line);
  if (!document) return tl::unexpected(document.error());
  const auto type = read_type(*document, kTypes);
  if (!type) return tl::unexpected(type.error());
  FieldReader reader(document->root(), std::string((*type)->first));
  return (*type)->second(reader);
}

}  // namespace woodlouse::protocol
