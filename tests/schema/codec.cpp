// What the codec, the map reader and the replay reader know, told to the tests of docs/schema.
//
//     woodlouse_codec tables     names, ranges and samples, as one JSON object
//     woodlouse_codec judge      for each line `KIND TAB TEXT` of standard input "ok" or why it is refused.
//     KIND: client,
//                                server, all (server, with all columns and exact), map, recording (RS for its
//                                newlines)
#include <algorithm>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>

#include "samples.h"
#include "shared/json/object_text.h"
#include "shared/map/map_text.h"
#include "shared/map/modes.h"
#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"
#include "shared/replay/format.h"
#include "shared/replay/line_reader.h"

namespace woodlouse::schema {
namespace {

using json::ObjectText;

void append_name(std::string& out, protocol::Column column) { json::append_string(out, to_text(column)); }
void append_text(std::string& out, std::string_view text) { json::append_string(out, text); }

/// The types that there are, as the codec lists them to whoever sends another.
std::string types_of(const std::string& refusal) {
  constexpr std::string_view kBefore = "must be one of: ";
  const std::size_t at = refusal.find(kBefore);
  assert(at != std::string::npos);
  return refusal.substr(at + kBefore.size());
}

void add_columns(ObjectText& text) {
  text.object("columns", [](ObjectText& columns) {
    for (std::size_t k = 0; k < protocol::kColumnCount; ++k) {
      const auto column = static_cast<protocol::Column>(k);
      columns.object(to_text(column), [&](ObjectText& entry) {
        entry.boolean("whole", is_whole(column)).number("quantum", quantum(column));
      });
    }
  });
  text.array("default_columns", protocol::default_columns(), append_name);
  text.array("all_columns", protocol::all_columns(), append_name);
}

void add_events(ObjectText& text) {
  text.object("events", [](ObjectText& events) {
    for (std::size_t k = 0; k < protocol::kEventKindCount; ++k) {
      const auto kind = static_cast<protocol::EventKind>(k);
      events.array(to_text(kind), value_names(kind), append_text);
    }
  });
}

void add_limits(ObjectText& text) {
  text.objects("limits", protocol::limit_fields(), [](ObjectText& entry, const protocol::LimitField& field) {
    entry.text("name", field.name).integer("least", field.least).integer("most", field.most);
    entry.boolean("is_option", field.is_option).text("meaning", field.meaning);
  });
  text.object("codes", [](ObjectText& codes) {
    for (const protocol::CodeEntry& entry : protocol::codes()) codes.text(entry.code, entry.messages);
  });
}

void add_numbers(ObjectText& text) {
  text.object("numbers", [](ObjectText& numbers) {
    numbers.integer("max_integer", protocol::kMaxInteger).integer("max_state_hz", protocol::kMaxStateHz);
    numbers.integer("max_thrust_ticks", protocol::kMaxThrustTicks).integer("most_rank", protocol::kMostRank);
    numbers.integer("max_table_rows", protocol::kMaxTableRows).integer("most_splits", protocol::kMostSplits);
    numbers.integer("most_records_shown", protocol::kMostRecordsShown);
    numbers.integer("most_ghost_inputs", state::kMostGhostInputs)
        .integer("max_room_bytes", protocol::kMaxRoomBytes);
    numbers.integer("max_gates", map::kMaxGates).integer("max_crumbs", map::kMaxCrumbs);
    numbers.integer("max_places", map::kMaxPlaces).integer("max_lice", replay::kMaxLice);
    numbers.integer("max_steps", replay::kMaxStepsBetweenKeyframes);
    numbers.integer("protocol", protocol::kProtocolVersion).integer("format", replay::kFormatVersion);
    numbers.integer("behavior", match::kBehavior);
  });
}

template <typename Message>
void add_samples(ObjectText& text, std::string_view name, const std::vector<Message>& samples) {
  text.array(name, samples, [](std::string& out, const Message& message) {
    std::string line = encode(message);
    line.pop_back();
    json::append_string(out, line);
  });
}

std::string tables() {
  constexpr std::string_view kNone = R"({"type":"none"})";
  std::string out;
  ObjectText text(out);
  text.text("client_types", types_of(protocol::decode_client(kNone).error().text));
  text.text("server_types", types_of(protocol::decode_server(kNone, {}, {}).error().text));
  add_columns(text);
  add_events(text);
  add_limits(text);
  add_numbers(text);
  add_samples(text, "client_samples", client_samples());
  add_samples(text, "server_samples", server_samples());
  text.end_line();
  return out;
}

std::string recording_verdict(std::string lines) {
  std::replace(lines.begin(), lines.end(), '\x1e', '\n');
  std::istringstream in(lines);
  replay::ReplayReader reader(in, "recording");
  if (const auto header = reader.read_header(); !header) return header.error().text();
  for (;;) {
    const auto line = reader.next_line();
    if (!line) return line.error().text();
    if (!*line) return "ok";
  }
}

template <typename Decoded>
std::string verdict_of(const Decoded& message) {
  return message ? "ok" : message.error().code;
}

std::string verdict(std::string_view kind, const std::string& text) {
  using protocol::Format;
  if (kind == "client") return verdict_of(protocol::decode_client(text));
  if (kind == "server")
    return verdict_of(protocol::decode_server(text, protocol::default_columns(), Format::kQuantized));
  if (kind == "all")
    return verdict_of(protocol::decode_server(text, protocol::all_columns(), Format::kExact));
  if (kind == "recording") return recording_verdict(text);
  assert(kind == "map");
  const auto map = map::parse_map(text, "map", nullptr);
  return map ? "ok" : map.error().text();
}

int main_of(std::string_view what) {
  if (what == "tables") {
    std::cout << tables();
    return 0;
  }
  if (what != "judge") return 2;
  std::string line;
  while (std::getline(std::cin, line)) {
    const std::size_t tab = line.find('\t');
    assert(tab != std::string::npos);
    std::string told = verdict(std::string_view(line).substr(0, tab), line.substr(tab + 1));
    std::replace(told.begin(), told.end(), '\n', ' ');
    std::cout << told << '\n';
  }
  return 0;
}

}  // namespace
}  // namespace woodlouse::schema

int main(int count, char** arguments) { return count == 2 ? woodlouse::schema::main_of(arguments[1]) : 2; }
