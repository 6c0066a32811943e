#include <cassert>

#include "shared/json/object_text.h"
#include "shared/protocol/codec.h"

namespace woodlouse::protocol {
namespace {

void append_name(std::string& out, Column column) { json::append_string(out, to_text(column)); }

void append_view(json::ObjectText& text, const View& view) {
  assert(!view.place || !view.louse);
  if (view.place) text.number("x", view.place->x).number("y", view.place->y);
  if (view.louse) text.integer("louse", *view.louse);
  if (view.radius) text.number("radius", *view.radius);
  if (view.rows) text.integer("rows", *view.rows);
}

void append_line(std::string& out, const Join& join) {
  json::ObjectText text(out, "join");
  text.integer("protocol", join.protocol).text("role", to_text(join.role)).text("name", join.name);
  if (!join.room.empty()) text.text("room", join.room);
  if (!join.fields.empty()) text.array("fields", join.fields, append_name);
  text.text("format", to_text(join.format));
  if (join.state_hz) text.integer("state_hz", *join.state_hz);
  if (join.stream == Stream::kInputs) text.text("stream", to_text(join.stream));
  if (!join.resume.empty())
    text.text("resume", join.resume);
  else if (join.may_resume)
    text.boolean("resume", true);
  if (join.view) text.object("view", [&](json::ObjectText& view) { append_view(view, *join.view); });
  if (!join.token.empty()) text.text("token", join.token);
  text.end_line();
}

void append_line(std::string& out, const Input& input) {
  json::ObjectText text(out, "input");
  text.integer("seq", input.seq);
  if (input.thrust.kind == state::ThrustKind::kMapVector) {
    text.pair("thrust", input.thrust.value);
  } else {
    text.number("thrust", input.thrust.value.x);
  }
  if (input.ticks) text.integer("ticks", *input.ticks);
  if (input.tick) text.integer("tick", *input.tick);
  text.end_line();
}

void append_line(std::string& out, const Chat& chat) {
  json::ObjectText(out, "chat").text("text", chat.text).end_line();
}
void append_line(std::string& out, const List& list) {
  json::ObjectText text(out, "list");
  if (list.watch) text.boolean("watch", true);
  text.end_line();
}
void append_line(std::string& out, const GetMap&) { json::ObjectText(out, "get_map").end_line(); }
void append_line(std::string& out, const Resync&) { json::ObjectText(out, "resync").end_line(); }
void append_line(std::string& out, const Respawn& respawn) {
  json::ObjectText text(out, "respawn");
  if (respawn.at_gate) text.text("at", "gate");
  text.end_line();
}
void append_line(std::string& out, const Skip&) { json::ObjectText(out, "skip").end_line(); }
void append_line(std::string& out, const Look& look) {
  json::ObjectText text(out, "view");
  append_view(text, look.view);
  text.end_line();
}
void append_line(std::string& out, const Leave&) { json::ObjectText(out, "leave").end_line(); }
void append_line(std::string& out, const Ping& ping) {
  json::ObjectText(out, "ping").integer("t", ping.t).end_line();
}
void append_line(std::string& out, const Pong& pong) {
  json::ObjectText(out, "pong").integer("t", pong.t).end_line();
}

void append_line(std::string& out, const ListRecords& list) {
  json::ObjectText(out, "list_records").text("board", to_text(list.board)).end_line();
}
void append_line(std::string& out, const GetGhost& get) {
  json::ObjectText(out, "get_ghost").text("board", to_text(get.board)).integer("rank", get.rank).end_line();
}

void append_line(std::string& out, const Moderate& moderate) {
  json::ObjectText text(out, "moderate");
  text.text("action", moderate.action);
  if (!moderate.who.empty()) text.text("who", moderate.who);
  if (!moderate.text.empty()) text.text("text", moderate.text);
  if (moderate.seconds) text.integer("seconds", *moderate.seconds);
  text.end_line();
}

}  // namespace

std::string encode(const ClientMessage& message) {
  std::string line;
  std::visit([&line](const auto& alternative) { append_line(line, alternative); }, message);
  return line;
}

}  // namespace woodlouse::protocol
