#include "shared/replay/line_writer.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>
#include <variant>

#include "shared/json/object_text.h"
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
    case match::RosterAction::kRespawnAtGate:
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

void append_roster_change(json::ObjectText& entry, const match::RosterChange& change) {
  entry.integer(to_text(change.action), change.player);
  if (change.action == match::RosterAction::kRespawnAtGate) entry.text("at", "gate");
  if (change.action != match::RosterAction::kJoin) return;
  entry.text("name", change.label.name).text("role", protocol::to_text(change.label.role));
}

/// [player, seq, thrust, margin in ms, ticks]: what is not known, or held, is left out at the end.
void append_input(std::string& out, const match::AppliedInput& input, std::optional<std::int64_t> margin) {
  json::append_integer(out += '[', input.player);
  json::append_integer(out += ',', input.seq);
  append_thrust(out += ',', input.kind, input.thrust);
  const bool has_ticks = input.ticks != state::kHeld;
  if (margin) {
    json::append_integer(out += ',', *margin);
  } else if (has_ticks) {
    out += ",null";
  }
  if (has_ticks) json::append_integer(out += ',', input.ticks);
  out += ']';
}

void append_waiting(std::string& out, const match::AppliedInput& input) {
  json::append_integer(out += '[', input.tick);
  json::append_integer(out += ',', input.player);
  json::append_integer(out += ',', input.seq);
  append_thrust(out += ',', input.kind, input.thrust);
  if (input.ticks != state::kHeld) json::append_integer(out += ',', input.ticks);
  out += ']';
}

void append_player(std::string& out, const match::PlayerSeq& player, const match::PlayerLabel& label) {
  json::append_integer(out += '[', player.player);
  out += ',';
  if (player.last_seq) {
    json::append_integer(out, *player.last_seq);
  } else {
    out += "null";
  }
  json::append_string(out += ',', label.name);
  json::append_string(out += ',', protocol::to_text(label.role));
  out += ']';
}

/// Two digits a byte.
std::string hex_text(std::string_view bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  text.reserve(2 * bytes.size());
  for (const char byte : bytes) {
    text += kDigits[static_cast<unsigned char>(byte) >> 4];
    text += kDigits[static_cast<unsigned char>(byte) & 15];
  }
  return text;
}

void append_name(std::string& out, const state::LouseField& field) { json::append_string(out, field.name); }

void append_louse(std::string& out, const state::Louse& louse) {
  json::append_array(out, state::kLouseFields, [&](std::string& row, const state::LouseField& field) {
    const double value = state::field_value(louse, field);
    if (state::holds_integer(field)) {
      json::append_integer(row, static_cast<std::uint32_t>(value));
    } else {
      json::append_double(row, value);
    }
  });
}

void end_line(std::string& out, json::ObjectText& line) {
  line.end();
  out += '\n';
}

}  // namespace

bool holds_map(const map::Map& map) {
  return !std::holds_alternative<map::TiledTerrain>(map.definition.terrain) &&
         map.canonical.size() <= kMaxInlineMapBytes;
}

Header make_header(const match::Match& match, std::string_view build, std::string_view map_file) {
  Header header;
  header.build = build;
  header.seed = match.settings().seed;
  header.tick_hz = match.settings().tick_hz;
  header.mode = match.settings().mode;
  header.map_name = match.map().definition.name;
  header.map_hash = match.map().hash;
  if (holds_map(match.map())) header.map_definition = match.map().canonical;
  header.map_file = map_file;
  return header;
}

void append_header(std::string& out, const Header& header) {
  json::ObjectText line(out);
  line.text("format", kFormat).integer("version", kFormatVersion).integer("behavior", header.behavior);
  line.text("build", header.build);
  // Text, because many readers hold numbers as doubles.
  line.text("seed", std::to_string(header.seed)).integer("tick_hz", header.tick_hz);
  if (header.mode != state::Mode::kRoam) line.text("mode", state::to_text(header.mode));
  if (header.parent) {
    line.object("parent", [&](json::ObjectText& parent) {
      parent.text("file", header.parent->file).integer("tick", header.parent->tick);
      parent.hash("hash", header.parent->hash);
    });
  }
  line.object("map", [&](json::ObjectText& map) {
    map.text("name", header.map_name).hash("hash", header.map_hash);
    if (!header.map_definition.empty()) {
      map.json("definition", header.map_definition);
    } else {
      map.text("file", header.map_file);
    }
  });
  end_line(out, line);
}

void append_keyframe(std::string& out, const match::MatchState& state) {
  assert(state.roster.empty());
  json::ObjectText line(out);
  line.integer("keyframe", state.tick).hash("hash", state.hash).hash("previous", state.link.previous);
  line.hash("inputs", state.link.inputs).hash("roster", state.link.roster).hash("rules", state.link.rules);
  line.integer("link", state.link.tick).hash("generator", state.link.generator);
  line.integer("next_player", state.next_player);
  line.array("players", state.players, [&](std::string& list, const match::PlayerSeq& player) {
    append_player(list, player, state.labels.at(player.player));
  });
  line.array("waiting", state.waiting, append_waiting);
  line.array("columns", state::kLouseFields, append_name);
  line.array("lice", state.lice, append_louse);
  if (!state.rules.empty()) line.text("rules_state", hex_text(state.rules));
  end_line(out, line);
}

void append_step(std::string& out, const match::StepRecord& step, const Margins& margins) {
  json::ObjectText line(out);
  line.integer("step", step.tick);
  if (!step.roster.empty()) line.objects("roster", step.roster, append_roster_change);
  if (!step.inputs.empty()) {
    line.array("inputs", step.inputs, [&](std::string& list, const match::AppliedInput& input) {
      const auto margin = margins.find({input.player, input.seq});
      append_input(list, input, margin != margins.end() ? std::optional(margin->second) : std::nullopt);
    });
  }
  line.hash("hash", step.hash);
  end_line(out, line);
}

void append_quiet_steps(std::string& out, std::uint64_t first, std::uint64_t steps, std::uint64_t hash) {
  assert(steps >= 1);
  json::ObjectText line(out);
  line.integer("step", first);
  if (steps > 1) line.integer("steps", steps);
  line.hash("hash", hash);
  end_line(out, line);
}

void append_chat(std::string& out, const ChatLine& chat) {
  json::ObjectText line(out);
  line.integer("chat", chat.tick)
      .integer("player", chat.player)
      .text("name", chat.name)
      .text("text", chat.text);
  end_line(out, line);
}

void append_pause(std::string& out, const PauseLine& pause) {
  json::ObjectText line(out);
  line.integer("pause", pause.tick).integer("from", pause.from).integer("until", pause.until);
  end_line(out, line);
}

void append_end(std::string& out, const End& end) {
  json::ObjectText line(out);
  line.integer("end", end.tick).text("reason", end.reason).integer("index", end.index_offset);
  end_line(out, line);
}

}  // namespace woodlouse::replay
