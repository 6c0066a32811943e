#include "shared/replay/line_writer.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>
#include <variant>

#include "shared/core/stable_hash.h"
#include "shared/json/text.h"
#include "shared/state/louse_fields.h"

namespace woodlouse::replay {
namespace {

std::string_view to_text(match::RosterAction action) {
  switch (action) {
    case match::RosterAction::kJoin:
      return "join";
    case match::RosterAction::kLeave:
      return "leave";
    case match::RosterAction::kRespawn:
      return "respawn";
  }
  assert(false);
  return {};
}

bool is_plus_zero(double value) { return std::bit_cast<std::uint64_t>(value) == 0; }

/// Whole numbers count quanta; whatever is none of them, minus zero too, stands as itself, with its point.
void append_component(std::string& out, double value) {
  const double quanta = value / state::kThrustQuantum;
  const bool is_whole = quanta >= -128.0 && quanta <= 128.0 && std::trunc(quanta) == quanta;
  if (is_whole && (is_plus_zero(value) || value != 0.0)) {
    json::append_integer(out, static_cast<std::int64_t>(quanta));
  } else {
    json::append_double(out, value);
  }
}

/// null, a number along the heading, or a pair: as on the wire, so that the kind needs no field of its own.
void append_thrust(std::string& out, state::ThrustKind kind, core::Vec2 value) {
  switch (kind) {
    case state::ThrustKind::kNone:
      assert(is_plus_zero(value.x) && is_plus_zero(value.y));
      out += "null";
      return;
    case state::ThrustKind::kAlongHeading:
      assert(is_plus_zero(value.y));
      append_component(out, value.x);
      return;
    case state::ThrustKind::kMapVector:
      out += '[';
      append_component(out, value.x);
      out += ',';
      append_component(out, value.y);
      out += ']';
      return;
  }
  assert(false);
}

/// Calls write(element) for each, with commas between and brackets around.
template <typename List, typename Write>
void append_list(std::string& out, const List& list, const Write& write) {
  char before = '[';
  for (const auto& element : list) {
    out += before;
    before = ',';
    write(element);
  }
  if (before == '[') out += before;
  out += ']';
}

void append_number(std::string& out, std::string_view key, std::uint64_t value) {
  out += key;
  json::append_integer(out, value);
}

void append_hash(std::string& out, std::string_view key, std::uint64_t value) {
  out.append(key).append("\"").append(core::to_hex(value)).append("\"");
}

void append_roster(std::string& out, std::span<const match::RosterChange> roster,
                   const PlayerLabels& labels) {
  if (roster.empty()) return;
  out += ",\"roster\":";
  append_list(out, roster, [&](const match::RosterChange& change) {
    out.append("{\"").append(to_text(change.action));
    append_number(out, "\":", change.player);
    const auto label = labels.find(change.player);
    if (change.action == match::RosterAction::kJoin && label != labels.end()) {
      out += ",\"name\":";
      json::append_string(out, label->second.name);
      out += ",\"role\":";
      json::append_string(out, protocol::to_text(label->second.role));
    }
    out += '}';
  });
}

/// [player, seq, thrust, margin in ms, ticks]: what is not known, or held, is left out at the end.
void append_input(std::string& out, const match::AppliedInput& input, std::optional<std::int64_t> margin) {
  append_number(out, "[", input.player);
  append_number(out, ",", input.seq);
  out += ',';
  append_thrust(out, input.kind, input.thrust);
  const bool has_ticks = input.ticks != state::kHeld;
  if (margin) {
    out += ',';
    json::append_integer(out, *margin);
  } else if (has_ticks) {
    out += ",null";
  }
  if (has_ticks) append_number(out, ",", input.ticks);
  out += ']';
}

void append_waiting(std::string& out, const match::AppliedInput& input) {
  append_number(out, "[", input.tick);
  append_number(out, ",", input.player);
  append_number(out, ",", input.seq);
  out += ',';
  append_thrust(out, input.kind, input.thrust);
  if (input.ticks != state::kHeld) append_number(out, ",", input.ticks);
  out += ']';
}

void append_player(std::string& out, const match::PlayerSeq& player, const PlayerLabels& labels) {
  append_number(out, "[", player.player);
  out += ',';
  if (player.last_seq) {
    json::append_integer(out, *player.last_seq);
  } else {
    out += "null";
  }
  if (const auto label = labels.find(player.player); label != labels.end()) {
    out += ',';
    json::append_string(out, label->second.name);
    out += ',';
    json::append_string(out, protocol::to_text(label->second.role));
  }
  out += ']';
}

void append_columns(std::string& out) {
  append_list(out, state::kLouseFields,
              [&](const state::LouseField& field) { json::append_string(out, field.name); });
}

void append_louse(std::string& out, const state::Louse& louse) {
  append_list(out, state::kLouseFields, [&](const state::LouseField& field) {
    const double value = state::field_value(louse, field);
    if (state::holds_integer(field)) {
      json::append_integer(out, static_cast<std::uint32_t>(value));
    } else {
      json::append_double(out, value);
    }
  });
}

}  // namespace

Header make_header(const match::Match& match, std::string_view build, std::string_view map_file) {
  Header header;
  header.build = build;
  header.seed = match.settings().seed;
  header.tick_hz = match.settings().tick_hz;
  header.map_name = match.map().definition.name;
  header.map_hash = match.map().hash;
  const map::Map& map = match.map();
  const bool is_whole = !std::holds_alternative<map::TiledTerrain>(map.definition.terrain);
  if (is_whole && map.canonical.size() <= kMaxInlineMapBytes) header.map_definition = map.canonical;
  header.map_file = map_file;
  return header;
}

void append_header(std::string& out, const Header& header) {
  out += "{\"format\":";
  json::append_string(out, kFormat);
  append_number(out, ",\"version\":", kFormatVersion);
  append_number(out, ",\"behavior\":", static_cast<std::uint64_t>(header.behavior));
  out += ",\"build\":";
  json::append_string(out, header.build);
  // Text, because many readers hold numbers as doubles.
  out.append(",\"seed\":\"").append(std::to_string(header.seed));
  append_number(out, "\",\"tick_hz\":", header.tick_hz);
  if (header.parent) {
    out += ",\"parent\":{\"file\":";
    json::append_string(out, header.parent->file);
    append_number(out, ",\"tick\":", header.parent->tick);
    append_hash(out, ",\"hash\":", header.parent->hash);
    out += '}';
  }
  out += ",\"map\":{\"name\":";
  json::append_string(out, header.map_name);
  append_hash(out, ",\"hash\":", header.map_hash);
  if (!header.map_definition.empty()) {
    out.append(",\"definition\":").append(header.map_definition);
  } else {
    out += ",\"file\":";
    json::append_string(out, header.map_file);
  }
  out += "}}\n";
}

void append_keyframe(std::string& out, const match::MatchState& state, const PlayerLabels& labels) {
  append_number(out, "{\"keyframe\":", state.tick);
  append_hash(out, ",\"hash\":", state.hash);
  append_hash(out, ",\"previous\":", state.previous);
  append_hash(out, ",\"inputs\":", state.inputs);
  append_hash(out, ",\"generator\":", state.generator);
  append_number(out, ",\"next_player\":", state.next_player);
  out += ",\"players\":";
  append_list(out, state.players,
              [&](const match::PlayerSeq& player) { append_player(out, player, labels); });
  append_roster(out, state.roster, labels);
  out += ",\"waiting\":";
  append_list(out, state.waiting, [&](const match::AppliedInput& input) { append_waiting(out, input); });
  out += ",\"columns\":";
  append_columns(out);
  out += ",\"lice\":";
  append_list(out, state.lice, [&](const state::Louse& louse) { append_louse(out, louse); });
  out += "}\n";
}

void append_step(std::string& out, const match::StepRecord& step, const PlayerLabels& labels,
                 const Margins& margins) {
  append_number(out, "{\"step\":", step.tick);
  append_roster(out, step.roster, labels);
  if (!step.inputs.empty()) {
    out += ",\"inputs\":";
    append_list(out, step.inputs, [&](const match::AppliedInput& input) {
      const auto margin = margins.find({input.player, input.seq});
      append_input(out, input, margin != margins.end() ? std::optional(margin->second) : std::nullopt);
    });
  }
  append_hash(out, ",\"hash\":", step.hash);
  out += "}\n";
}

void append_chat(std::string& out, const ChatLine& line) {
  append_number(out, "{\"chat\":", line.tick);
  append_number(out, ",\"player\":", line.player);
  out += ",\"name\":";
  json::append_string(out, line.name);
  out += ",\"text\":";
  json::append_string(out, line.text);
  out += "}\n";
}

void append_end(std::string& out, const End& end) {
  append_number(out, "{\"end\":", end.tick);
  out += ",\"reason\":";
  json::append_string(out, end.reason);
  append_number(out, ",\"index\":", end.index_offset);
  out += "}\n";
}

}  // namespace woodlouse::replay
