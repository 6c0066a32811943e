#include "shared/json/object_text.h"
#include "shared/protocol/codec.h"

namespace woodlouse::protocol {
namespace {

void append_name(std::string& out, Column column) { json::append_string(out, to_text(column)); }

std::string line_of(const Join& join) {
  json::ObjectText text("join");
  text.integer("protocol", join.protocol).text("role", to_text(join.role)).text("name", join.name);
  if (!join.room.empty()) text.text("room", join.room);
  if (!join.fields.empty()) text.array("fields", join.fields, append_name);
  text.text("format", to_text(join.format));
  if (join.state_hz) text.integer("state_hz", *join.state_hz);
  return text.line();
}

std::string line_of(const Input& input) {
  json::ObjectText text("input");
  text.integer("seq", input.seq);
  if (input.thrust.kind == state::ThrustKind::kMapVector) {
    text.pair("thrust", input.thrust.value);
  } else {
    text.number("thrust", input.thrust.value.x);
  }
  if (input.ticks) text.integer("ticks", *input.ticks);
  if (input.tick) text.integer("tick", *input.tick);
  return text.line();
}

std::string line_of(const Chat& chat) { return json::ObjectText("chat").text("text", chat.text).line(); }
std::string line_of(const List&) { return json::ObjectText("list").line(); }
std::string line_of(const GetMap&) { return json::ObjectText("get_map").line(); }
std::string line_of(const Resync&) { return json::ObjectText("resync").line(); }
std::string line_of(const Respawn&) { return json::ObjectText("respawn").line(); }
std::string line_of(const Leave&) { return json::ObjectText("leave").line(); }
std::string line_of(const Ping& ping) { return json::ObjectText("ping").integer("t", ping.t).line(); }
std::string line_of(const Pong& pong) { return json::ObjectText("pong").integer("t", pong.t).line(); }

}  // namespace

std::string encode(const ClientMessage& message) {
  return std::visit([](const auto& alternative) { return line_of(alternative); }, message);
}

}  // namespace woodlouse::protocol
