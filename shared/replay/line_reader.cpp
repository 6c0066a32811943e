#include "shared/replay/line_reader.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <span>
#include <utility>

#include "shared/core/joined.h"
#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/replay/byte_stream.h"
#include "shared/replay/header_reader.h"
#include "shared/replay/line_fields.h"
#include "shared/replay/step_line.h"
#include "shared/state/louse_fields.h"

namespace woodlouse::replay {
namespace {

using core::joined;
using json::Fields;
using json::Problems;
using json::Range;

constexpr std::size_t kMaxDepth = 8;
constexpr std::size_t kMaxValues = 4'000'000;  // of a line of kMaxReplayLineBytes
constexpr std::uint64_t kMaxUint32 = std::numeric_limits<std::uint32_t>::max();
constexpr Range kCoordinate{-1e300, 1e300, ""};

template <typename T>
T as(std::optional<std::uint64_t> value) {
  return static_cast<T>(value.value_or(0));
}

// ---- a step ----------------------------------------------------------------------------------------------

/// Where a respawn leads, if not to a spawn.
void read_at(const json::Value& at, match::RosterChange& change, Problems& problems) {
  const bool is_gate = at.is(json::Kind::kString) && at.text() == "gate";
  if (!is_gate || change.action != match::RosterAction::kRespawn)
    return problems.add(at, "is known of a respawn alone, and \"gate\" is all that it can be");
  change.action = match::RosterAction::kRespawnAtGate;
}

void read_change(const json::Value& value, StepLine& line, Problems& problems) {
  using match::RosterAction;
  constexpr std::pair<std::string_view, RosterAction> kActions[] = {
      {"join", RosterAction::kJoin}, {"leave", RosterAction::kLeave}, {"respawn", RosterAction::kRespawn}};
  for (const auto& [key, action] : kActions) {
    const auto player = value.find(key);
    if (!player) continue;
    match::RosterChange change{action,
                               as<match::PlayerId>(json::integer_in(*player, 1, kMaxUint32 - 1, problems))};
    if (action == RosterAction::kJoin) {
      const Fields fields(value, {key, "name", "role"}, problems);
      const auto name = fields.demand("name");
      const auto role = fields.demand("role");
      if (name && role) change.label = label_of(*name, *role, problems);
    } else {
      const Fields fields(value, {key, "at"}, problems);
      if (const auto at = fields.find("at")) read_at(*at, change, problems);
    }
    line.step.roster.push_back(std::move(change));
    return;
  }
  problems.add(value, "{\"join\": id}, {\"leave\": id} or {\"respawn\": id} is wanted");
}

/// `values` from its front: player, seq, thrust.
match::AppliedInput read_push(std::span<const json::Value> values, Problems& problems) {
  match::AppliedInput input;
  input.player = as<match::PlayerId>(json::integer_in(values[0], 1, kMaxUint32 - 1, problems));
  input.seq = as<std::uint32_t>(json::integer_in(values[1], 0, kMaxUint32, problems));
  input.ticks = state::kHeld;
  read_thrust(values[2], input, problems);
  return input;
}

std::uint32_t read_ticks(const json::Value& value, Problems& problems) {
  return as<std::uint32_t>(json::integer_in(value, 0, state::kHeld - 1, problems));
}

void read_input(const json::Value& value, StepLine& line, Problems& problems) {
  const std::vector<json::Value> values = value.children();
  if (!value.is(json::Kind::kArray) || values.size() < 3 || values.size() > 5) {
    return problems.add(value, "[player, seq, thrust, margin in ms, ticks] is wanted");
  }
  match::AppliedInput input = read_push(values, problems);
  input.tick = line.step.tick;
  std::optional<std::int64_t> margin;
  if (values.size() > 3 && !values[3].is(json::Kind::kNull)) {
    margin = values[3].integer();
    if (!margin) problems.add(values[3], "a whole number is wanted");
  }
  if (values.size() > 4) input.ticks = read_ticks(values[4], problems);
  line.step.inputs.push_back(input);
  line.margins_ms.push_back(margin);
}

StepLine read_step(const json::Value& root, Problems& problems) {
  const Fields fields(root, {"step", "steps", "roster", "inputs", "hash"}, problems);
  StepLine line;
  line.step.tick = fields.integer("step", 0, kMaxTick);
  line.step.hash = fields.hash("hash");
  if (const auto roster = fields.find("roster")) {
    read_list(*roster, problems, [&](const json::Value& value) { read_change(value, line, problems); });
  }
  if (const auto inputs = fields.find("inputs")) {
    read_list(*inputs, problems, [&](const json::Value& value) { read_input(value, line, problems); });
  }
  if (const auto steps = fields.find("steps")) {
    line.steps = json::integer_in(*steps, 2, kMaxStepsBetweenKeyframes, problems).value_or(2);
    if (!line.step.roster.empty() || !line.step.inputs.empty())
      problems.add(*steps, "of a step with a roster or inputs, which is one");
  }
  return line;
}

// ---- a keyframe ------------------------------------------------------------------------------------------

state::Louse read_louse(const json::Value& row, Problems& problems) {
  state::Louse louse;
  const std::size_t wanted = state::kLouseFields.size();
  if (!row.is(json::Kind::kArray) || row.size() != wanted) {
    problems.add(row, joined({"a row of ", std::to_string(wanted), " numbers is wanted"}));
    return louse;
  }
  std::size_t k = 0;
  row.for_each([&](const json::Value& number) {
    const state::LouseField& field = state::kLouseFields[k++];
    const double value = state::holds_integer(field)
                             ? as<std::uint32_t>(json::integer_in(number, 0, field.largest, problems))
                             : json::number_in(number, kCoordinate, problems).value_or(0.0);
    state::set_field(louse, field, value);
    return true;
  });
  return louse;
}

void read_columns(const json::Value& columns, Problems& problems) {
  const std::vector<json::Value> names = columns.children();
  const bool same =
      std::equal(names.begin(), names.end(), state::kLouseFields.begin(), state::kLouseFields.end(),
                 [](const json::Value& name, const state::LouseField& field) {
                   return name.is(json::Kind::kString) && name.text() == field.name;
                 });
  if (!same) problems.add(columns, "are not the columns of this version");
}

void read_player(const json::Value& value, Keyframe& keyframe, Problems& problems) {
  if (keyframe.state.players.size() == kMaxLice)
    return problems.add(
        value, joined({"more than ", std::to_string(kMaxLice), " players: no server takes so many"}));
  const std::vector<json::Value> values = value.children();
  if (!value.is(json::Kind::kArray) || values.size() != 4) {
    return problems.add(value, "[player, seq, name, role] is wanted");
  }
  match::PlayerSeq player;
  player.player = as<match::PlayerId>(json::integer_in(values[0], 1, kMaxUint32 - 1, problems));
  if (!values[1].is(json::Kind::kNull)) {
    player.last_seq = as<std::uint32_t>(json::integer_in(values[1], 0, kMaxUint32, problems));
  }
  keyframe.state.players.push_back(player);
  keyframe.state.labels[player.player] = label_of(values[2], values[3], problems);
}

void read_waiting(const json::Value& value, Keyframe& keyframe, Problems& problems) {
  const std::vector<json::Value> values = value.children();
  if (!value.is(json::Kind::kArray) || values.size() < 4 || values.size() > 5) {
    return problems.add(value, "[tick, player, seq, thrust, ticks] is wanted");
  }
  match::AppliedInput input = read_push(std::span(values).subspan(1), problems);
  input.tick = json::integer_in(values[0], 0, 2 * kMaxTick, problems).value_or(0);
  if (values.size() > 4) input.ticks = read_ticks(values[4], problems);
  keyframe.state.waiting.push_back(input);
}

Keyframe read_keyframe(const json::Value& root, Problems& problems) {
  const Fields fields(root,
                      {"keyframe", "hash", "previous", "inputs", "roster", "rules", "rules_state", "link",
                       "generator", "next_player", "players", "waiting", "columns", "lice"},
                      problems);
  Keyframe keyframe;
  match::MatchState& state = keyframe.state;
  state.tick = fields.integer("keyframe", 0, kMaxTick);
  state.hash = fields.hash("hash");
  state.link = {fields.hash("previous"),
                fields.hash("inputs"),
                fields.hash("roster"),
                fields.hash("rules"),
                fields.integer("link", 0, kMaxTick),
                fields.hash("generator")};
  if (const auto rules = fields.find("rules_state")) state.rules = bytes_of(*rules, problems);
  state.next_player = static_cast<match::PlayerId>(fields.integer("next_player", 1, kMaxUint32));
  const auto list = [&](std::string_view key, const auto& read) {
    if (const auto value = fields.demand(key)) read_list(*value, problems, read);
  };
  list("players", [&](const json::Value& value) { read_player(value, keyframe, problems); });
  list("waiting", [&](const json::Value& value) { read_waiting(value, keyframe, problems); });
  if (const auto columns = fields.demand("columns")) read_columns(*columns, problems);
  list("lice", [&](const json::Value& row) { state.lice.push_back(read_louse(row, problems)); });
  return keyframe;
}

// ---- any line --------------------------------------------------------------------------------------------

ChatLine read_chat(const json::Value& root, Problems& problems) {
  const Fields fields(root, {"chat", "player", "name", "text"}, problems);
  ChatLine line;
  line.tick = fields.integer("chat", 0, kMaxTick);
  line.player = static_cast<match::PlayerId>(fields.integer("player", 0, kMaxUint32));
  line.name = fields.text("name", kMaxTextBytes);
  line.text = fields.text("text", kMaxTextBytes);
  return line;
}

PauseLine read_pause(const json::Value& root, Problems& problems) {
  const Fields fields(root, {"pause", "from", "until"}, problems);
  return {fields.integer("pause", 0, kMaxTick), fields.integer("from", 0, kMaxTick),
          fields.integer("until", 0, kMaxTick)};
}

/// Its other fields are checked by who reads it (index_text.cpp).
IndexLine read_index_line(const json::Value& root, Problems& problems) {
  const Fields fields(root, {"index", "keyframes", "players", "marks", "inputs"}, problems);
  return {fields.integer("index", 0, kMaxTick)};
}

End read_end(const json::Value& root, Problems& problems) {
  const Fields fields(root, {"end", "reason", "index"}, problems);
  End end;
  end.tick = fields.integer("end", 0, kMaxTick);
  end.reason = fields.text("reason", kMaxTextBytes);
  end.index_offset = fields.integer("index", 0, kMaxOffset);
  return end;
}

Line read_object(const json::Value& root, Problems& problems) {
  if (root.find("step")) return read_step(root, problems);
  if (root.find("keyframe")) return read_keyframe(root, problems);
  if (root.find("chat")) return read_chat(root, problems);
  if (root.find("pause")) return read_pause(root, problems);
  if (root.find("index") && !root.find("end")) return read_index_line(root, problems);
  if (root.find("end")) return read_end(root, problems);
  problems.add(root, "is no step, keyframe, chat, pause, index or end");
  return End{};
}

}  // namespace

std::string ReplayReader::place() const { return joined({source_, ":", std::to_string(line_number_)}); }

core::Expected<bool> ReplayReader::read_line() {
  line_offset_ += line_.empty() ? 0 : line_.size() + 1;
  line_.clear();
  StreamBuffer& bytes = *in_.rdbuf();
  const auto fail = [this](std::string what) {
    return core::fail(joined({source_, ":", std::to_string(line_number_ + 1)}), std::move(what));
  };
  for (std::string_view some = GetArea::of(bytes); !some.empty(); some = GetArea::of(bytes)) {
    some = some.substr(0, longest_line_ - line_.size() + 1);  // the last one is the newline, or too much
    const std::size_t size = std::min(some.find('\n'), some.size());
    if (line_.size() + size > longest_line_) {
      wants_longer_lines_ = longest_line_ < kMaxReplayLineBytes;
      return fail(joined({"a line longer than ", std::to_string(longest_line_ >> 20), " MiB"}));
    }
    line_ += some.substr(0, size);
    GetArea::take(bytes, std::min(size + 1, some.size()));
    if (size == some.size()) continue;
    ++line_number_;
    return true;
  }
  if (std::string fault = fault_of(in_); !fault.empty()) return fail(std::move(fault));
  if (order_.is_over() && !line_.empty()) return fail("stands after the end");
  cut_off_ = cut_off_ || !line_.empty() || replay::is_cut_off(in_);
  return false;
}

core::Expected<Header> ReplayReader::read_header() {
  const core::Expected<bool> whole = read_line();
  if (!whole) return tl::unexpected(whole.error());
  if (!*whole) {
    const bool is_empty = line_.empty() && !replay::is_cut_off(in_);
    return core::fail(source_, is_empty ? "is empty" : "has no whole line: it was cut off in the header");
  }
  const auto document = json::parse_file(line_, source_, {kMaxDepth, kMaxValues}, line_number_);
  if (!document && !line_.starts_with('{'))
    return core::fail(place(), "not JSON, and so no recording",
                      "one is .ndjson or .ndjson.zst, as a server's --record writes it");
  if (!document) return tl::unexpected(document.error());
  Problems problems(source_);
  Header header = replay::read_header(document->root(), problems);
  if (problems.count() != 0) return tl::unexpected(problems.errors().front());
  order_.begin();
  return header;
}

/// False: no further whole line.
core::Expected<bool> ReplayReader::read_into(Line& line) {
  const core::Expected<bool> whole = read_line();
  if (!whole || !*whole) return whole;
  if (auto step = scan_step(line_)) {
    line = std::move(*step);
    return true;
  }
  // Memory goes with the bytes and with the values: who takes shorter lines takes fewer values.
  const auto values =
      static_cast<std::size_t>(std::uint64_t{kMaxValues} * longest_line_ / kMaxReplayLineBytes);
  const auto document = json::parse_file(line_, source_, {kMaxDepth, values}, line_number_);
  if (!document) {
    wants_longer_lines_ = longest_line_ < kMaxReplayLineBytes;
    return tl::unexpected(document.error());
  }
  Problems problems(source_);
  line = read_object(document->root(), problems);
  if (problems.count() != 0) return tl::unexpected(problems.errors().front());
  return true;
}

core::Expected<std::optional<Line>> ReplayReader::next_line() {
  assert(quiet_.steps == 0);
  Line line;
  const core::Expected<bool> whole = read_into(line);
  if (!whole) return tl::unexpected(whole.error());
  if (!*whole) return core::Expected<std::optional<Line>>(tl::in_place);
  if (auto fits = order_.follow(line); !fits) {
    core::Error error = std::move(fits.error());
    error.where = error.where.empty() ? place() : joined({place(), ": ", error.where});
    return tl::unexpected(std::move(error));
  }
  return core::Expected<std::optional<Line>>(tl::in_place, std::move(line));
}

core::Expected<std::optional<Line>> ReplayReader::next() {
  if (quiet_.steps == 0) {
    core::Expected<std::optional<Line>> line = next_line();
    auto* step = line && *line ? std::get_if<StepLine>(&**line) : nullptr;
    if (step == nullptr || step->steps == 1) return line;
    quiet_ = std::move(*step);
  }
  assert(quiet_.step.inputs.empty() && quiet_.step.roster.empty());
  StepLine step;
  step.step.tick = quiet_.step.tick++;
  step.step.hash = quiet_.step.hash;
  --quiet_.steps;
  return core::Expected<std::optional<Line>>(tl::in_place, std::move(step));
}

}  // namespace woodlouse::replay
