#include "samples.h"

#include <cstdint>
#include <string>

namespace woodlouse::schema {

using namespace protocol;

namespace {

View some_view(std::optional<std::uint32_t> louse) {
  View view;
  [[maybe_unused]] const auto& [place, followed, radius, rows] = view;
  if (louse)
    view.louse = louse;
  else
    view.place = core::Vec2{3.5, -12};
  view.radius = 10;
  view.rows = 30;
  return view;
}

Join whole_join() {
  Join join;
  [[maybe_unused]] const auto& [protocol, role, name, room, fields, format, state_hz, may_resume, resume,
                                view, token, stream] = join;
  join.role = Role::kSpectator;
  join.name = "climber";
  join.room = "volcano";
  join.fields = all_columns();
  join.format = Format::kExact;
  join.state_hz = 10;
  join.stream = Stream::kInputs;
  join.may_resume = true;
  join.resume = "646801f8bdabf83c1a04ed33c112afec";
  join.view = some_view({});
  join.token = "correct-horse";
  return join;
}

Input whole_input() {
  Input input;
  [[maybe_unused]] const auto& [seq, thrust, clamped, ticks, tick] = input;
  input.seq = 2;
  input.thrust = {state::ThrustKind::kMapVector, {0.5, -0.75}};
  input.ticks = 30;
  input.tick = 4800;
  return input;
}

Hello whole_hello() {
  Hello hello;
  [[maybe_unused]] const auto& [protocol, behavior, server, session, rooms, features, limits, hosts] = hello;
  hello.behavior = 10;
  hello.server = "woodlouse-server 0.1.0";
  hello.session = "000000000000001f";
  hello.rooms = {"volcano", "hills"};
  hello.features = {"quantized", "exact"};
  hello.hosts = {"10.0.0.6:7777", "[2001:db8::7]:7777"};
  return hello;
}

PlayerEntry some_player() {
  PlayerEntry player{3, "bob", Role::kBot};
  [[maybe_unused]] const auto& [id, name, role] = player;
  return player;
}

Welcome whole_welcome() {
  Welcome welcome;
  [[maybe_unused]] const auto& [id, name, resume_token, resumed, room, tick, tick_hz, state_hz, fields,
                                format, stream, map_name, map_hash, extent, map_bytes, physics, mode, rules,
                                players, spectators, view_rows] = welcome;
  welcome.id = 7;
  welcome.name = "ann";
  welcome.resume_token = "646801f8bdabf83c1a04ed33c112afec";
  welcome.room = "volcano/forage";
  welcome.tick = 811;
  welcome.fields = {Column::kId, Column::kX, Column::kYaw, Column::kTx, Column::kDistance};
  welcome.stream = Stream::kInputs;
  welcome.map_name = "volcano";
  welcome.map_hash = 0x0123456789abcdef;
  welcome.extent = {-20, -20, 20, 20};
  welcome.map_bytes = 9876;
  welcome.mode = "forage";
  welcome.rules = R"({"crumbs":24,"radius":0.9,"round_s":180,"podium_s":10,"summits":4})";
  welcome.players = {some_player()};
  welcome.spectators = 2;
  welcome.view_rows = kEveryRow;
  return welcome;
}

Ack whole_ack() {
  Ack ack;
  [[maybe_unused]] const auto& [seq, tick, margin_us, late, dropped, clamped, you] = ack;
  ack.seq = 1;
  ack.tick = 812;
  ack.margin_us = -250;
  ack.you.emplace();
  ack.you->tick = 813;
  ack.you->louse.id = 7;
  ack.you->louse.thrust_kind = state::ThrustKind::kMapVector;
  return ack;
}

Event event_of(EventKind kind) {
  Event event;
  [[maybe_unused]] const auto& [n, tick, own_kind, id, name, role, text, moment, values, phase, table] =
      event;
  event.n = 12;
  event.tick = 811;
  event.kind = kind;
  event.id = 7;
  event.name = "ann";
  event.text = "hello";
  event.moment = 78654321;
  for (std::size_t k = 0; k < event.values.size(); ++k) event.values[k] = static_cast<std::int64_t>(k) - 1;
  event.phase = GamePhase::kPodium;
  event.table = {{7, 181347123}, {3, 0}};
  return event;
}

RecordRun some_run() {
  RecordRun run{Board::kBots, "ann", Role::kPlayer, 52756480, {9988096, 52756480}, 1767225600};
  [[maybe_unused]] const auto& [board, name, role, time, splits, when] = run;
  return run;
}

GhostLine whole_ghost() {
  GhostLine line;
  [[maybe_unused]] const auto& [run, start, behavior, tick_hz, ghost] = line;
  [[maybe_unused]] const auto& [spawn, ticks, inputs] = line.ghost;
  line.run = some_run();
  line.start = 3932160;
  line.behavior = 10;
  line.ghost.ticks = 866;
  line.ghost.inputs = {{0, {state::ThrustKind::kMapVector, {1, 0}}, 90}};
  return line;
}

MapMessage map_of(bool is_overview) {
  MapMessage map;
  [[maybe_unused]] const auto& [name, hash, definition, overview, knots] = map;
  map.name = "alps";
  map.hash = 0x0123456789abcdef;
  map.definition =
      is_overview
          ? R"({"name":"alps","terrain":{"file":"alps.flt","storage":"tiles","fingerprint":"00c0ffee00c0ffee"}})"
          : R"({"name":"alps","terrain":{"function":"hills"}})";
  map.is_overview = is_overview;
  terrain::HeightGrid& grid = map.knots.emplace();
  grid.columns = grid.rows = 4;
  grid.dx = grid.dy = 1.0;
  grid.heights.assign(16, 0.5);
  return map;
}

template <typename Message>
Message coded(const char* code) {
  Message message{};
  message.code = code;
  message.text = "what, where, what to do";
  return message;
}

ErrorMessage whole_error() {
  auto error = coded<ErrorMessage>("rate_limited");
  [[maybe_unused]] const auto& [code, text, fatal, retry_after_ms, address] = error;
  error.address = "10.0.0.6:7777";
  error.retry_after_ms = 250;
  return error;
}

Bye whole_bye() {
  auto bye = coded<Bye>("shutdown");
  [[maybe_unused]] const auto& [code, text, resumable, address] = bye;
  bye.address = "10.0.0.6:7777";
  return bye;
}

Notice whole_notice() {
  auto notice = coded<Notice>("rate_lowered");
  [[maybe_unused]] const auto& [code, text] = notice;
  return notice;
}

Rooms whole_rooms() {
  Rooms rooms{{{"volcano", "volcano", 2, 3, 0, "FKTPZ", "10.0.0.6:7777"}}};
  [[maybe_unused]] const auto& [list] = rooms;
  [[maybe_unused]] const auto& [name, map, players, bots, spectators, code, address] = rooms.rooms.front();
  return rooms;
}

Records whole_records() {
  Records records{Board::kPeople, 1, {{1, some_run()}}};
  [[maybe_unused]] const auto& [board, count, rows] = records;
  return records;
}

}  // namespace

std::vector<ClientMessage> client_samples() {
  static_assert(std::variant_size_v<ClientMessage> == 15, "a message without a sample");
  Join plain;
  plain.name = "ann";
  plain.fields.clear();
  Join again = plain;
  again.may_resume = true;
  Input push;
  push.thrust = {state::ThrustKind::kAlongHeading, {1, 0}};
  const Respawn respawn{true};
  [[maybe_unused]] const auto& [at_gate] = respawn;
  const Chat chat{"hello"};
  [[maybe_unused]] const auto& [text] = chat;
  const Look look{some_view(7)};
  [[maybe_unused]] const auto& [its_view] = look;
  const Moderate mute{"mute", "ann", "", 600};
  [[maybe_unused]] const auto& [action, who, said, seconds] = mute;
  const GetGhost ghost{Board::kHandedIn, 3};
  [[maybe_unused]] const auto& [board, rank] = ghost;
  const ListRecords list{Board::kBots};
  [[maybe_unused]] const auto& [its_board] = list;
  return {whole_join(), plain,
          again,        whole_input(),
          push,         chat,
          List{},       List{true},
          GetMap{},     Resync{},
          respawn,      Respawn{},
          Skip{},       look,
          Look{},       Ping{123},
          Pong{-99},    list,
          ghost,        Leave{},
          mute,         Moderate{"say", "", "hello", {}}};
}

std::vector<ServerMessage> server_samples() {
  static_assert(std::variant_size_v<ServerMessage> == 14, "a message without a sample");
  Ack dropped;
  dropped.dropped = true;
  std::vector<ServerMessage> samples = {
      whole_hello(), whole_welcome(), whole_ack(),     dropped,       whole_notice(),
      whole_error(), whole_bye(),     whole_rooms(),   map_of(true),  map_of(false),
      Ping{1},       Pong{-1},        whole_records(), whole_ghost(), Ping{2, {{"10.0.0.6:7777"}}}};
  for (std::size_t k = 0; k < kEventKindCount; ++k) samples.emplace_back(event_of(static_cast<EventKind>(k)));
  return samples;
}

}  // namespace woodlouse::schema
