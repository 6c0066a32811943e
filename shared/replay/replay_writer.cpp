#include <bit>
#include <cassert>
#include <type_traits>
#include <utility>

#include "shared/json/text.h"
#include "shared/replay/louse_fields.h"
#include "shared/replay/replay_file.h"

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

/// null, a number along the heading, or a pair: as on the wire, so that the kind needs no field of its own.
void append_thrust(std::string& out, physics::ThrustKind kind, core::Vec2 value) {
  switch (kind) {
    case physics::ThrustKind::kNone:
      assert(is_plus_zero(value.x) && is_plus_zero(value.y));
      out += "null";
      return;
    case physics::ThrustKind::kAlongHeading:
      assert(is_plus_zero(value.y));
      json::append_double(out, value.x);
      return;
    case physics::ThrustKind::kMapVector:
      out += '[';
      json::append_double(out, value.x);
      out += ',';
      json::append_double(out, value.y);
      out += ']';
      return;
  }
  assert(false);
}

void append_louse(std::string& out, const physics::Louse& louse) {
  char before = '[';
  visit_fields(louse, [&](std::string_view, const auto& field) {
    out += before;
    before = ',';
    using Field = std::remove_cvref_t<decltype(field)>;
    if constexpr (std::is_same_v<Field, double>) {
      json::append_double(out, field);
    } else {
      out += std::to_string(static_cast<std::uint32_t>(field));
    }
  });
  out += ']';
}

void append_keyframe(std::string& out, std::uint64_t tick, std::span<const physics::Louse> lice) {
  out.append("{\"keyframe\":").append(std::to_string(tick)).append(",\"columns\":");
  char before = '[';
  visit_fields(physics::Louse{}, [&](std::string_view name, const auto&) {
    out += before;
    before = ',';
    json::append_string(out, name);
  });
  out += "],\"lice\":[";
  for (std::size_t k = 0; k < lice.size(); ++k) {
    if (k != 0) out += ',';
    append_louse(out, lice[k]);
  }
  out += "]}\n";
}

}  // namespace

Header make_header(const match::Match& match, std::string_view build, std::string_view map_file) {
  Header header;
  header.build = build;
  header.seed = match.settings().seed;
  header.tick_hz = match.settings().tick_hz;
  header.map_name = match.map().definition.name;
  header.map_hash = match.map().hash;
  if (match.map().canonical.size() <= kMaxInlineMapBytes) header.map_definition = match.map().canonical;
  header.map_file = map_file;
  return header;
}

void ReplayWriter::append_header(std::string& out, const Header& header) const {
  out += "{\"format\":";
  json::append_string(out, kFormat);
  out.append(",\"version\":").append(std::to_string(kFormatVersion));
  out.append(",\"behavior\":").append(std::to_string(header.behavior)).append(",\"build\":");
  json::append_string(out, header.build);
  // Text, because many readers hold numbers as doubles.
  out.append(",\"seed\":\"").append(std::to_string(header.seed)).append("\",\"tick_hz\":");
  out.append(std::to_string(header.tick_hz)).append(",\"map\":{\"name\":");
  json::append_string(out, header.map_name);
  out.append(",\"hash\":\"").append(core::to_hex(header.map_hash)).append("\"");
  if (!header.map_definition.empty()) {
    out.append(",\"definition\":").append(header.map_definition);
  } else {
    out += ",\"file\":";
    json::append_string(out, header.map_file);
  }
  out += "}}\n";
}

void ReplayWriter::note_player(match::PlayerId player, std::string_view name, protocol::Role role) {
  labels_[player] = PlayerLabel{std::string(name), role};
}

void ReplayWriter::note_margin(match::PlayerId player, std::uint32_t seq, std::int64_t margin_us) {
  margins_[{player, seq}] = margin_us;
}

void ReplayWriter::append_roster(std::string& out, std::span<const match::RosterChange> roster) {
  if (roster.empty()) return;
  char before = '[';
  out += ",\"roster\":";
  for (const match::RosterChange& change : roster) {
    out += before;
    before = ',';
    out.append("{\"").append(to_text(change.action)).append("\":").append(std::to_string(change.player));
    const auto label = labels_.find(change.player);
    if (change.action == match::RosterAction::kJoin && label != labels_.end()) {
      out += ",\"name\":";
      json::append_string(out, label->second.name);
      out += ",\"role\":";
      json::append_string(out, protocol::to_text(label->second.role));
    }
    if (label != labels_.end()) labels_.erase(label);
    out += '}';
    if (change.action == match::RosterAction::kLeave) {  // what it had filed is dropped
      margins_.erase(margins_.lower_bound({change.player, 0}),
                     margins_.upper_bound({change.player, UINT32_MAX}));
    }
  }
  out += ']';
}

void ReplayWriter::append_inputs(std::string& out, std::span<const match::AppliedInput> inputs) {
  if (inputs.empty()) return;
  char before = '[';
  out += ",\"inputs\":";
  for (const match::AppliedInput& input : inputs) {
    out += before;
    before = ',';
    out.append("{\"player\":").append(std::to_string(input.player));
    out.append(",\"seq\":").append(std::to_string(input.seq)).append(",\"thrust\":");
    append_thrust(out, input.kind, input.thrust);
    if (input.ticks != physics::kHeld) out.append(",\"ticks\":").append(std::to_string(input.ticks));
    if (const auto margin = margins_.find({input.player, input.seq}); margin != margins_.end()) {
      out.append(",\"margin_us\":").append(std::to_string(margin->second));
      margins_.erase(margin);
    }
    out += '}';
  }
  out += ']';
}

void ReplayWriter::append_step(std::string& out, const match::StepRecord& step,
                               std::span<const physics::Louse> lice) {
  out.append("{\"step\":").append(std::to_string(step.tick));
  append_roster(out, step.roster);
  append_inputs(out, step.inputs);
  out.append(",\"hash\":\"").append(core::to_hex(step.hash)).append("\"}\n");
  if ((step.tick + 1) % keyframe_ticks_ == 0) append_keyframe(out, step.tick + 1, lice);
}

void ReplayWriter::append_chat(std::string& out, std::uint64_t tick, match::PlayerId player,
                               std::string_view name, std::string_view text) const {
  out.append("{\"chat\":").append(std::to_string(tick)).append(",\"player\":").append(std::to_string(player));
  out += ",\"name\":";
  json::append_string(out, name);
  out += ",\"text\":";
  json::append_string(out, text);
  out += "}\n";
}

void ReplayWriter::append_end(std::string& out, std::uint64_t tick, std::string_view reason) const {
  out.append("{\"end\":").append(std::to_string(tick)).append(",\"reason\":");
  json::append_string(out, reason);
  out += "}\n";
}

}  // namespace woodlouse::replay
