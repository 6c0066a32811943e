#include <algorithm>
#include <istream>
#include <limits>
#include <type_traits>
#include <utility>

#include "shared/core/joined.h"
#include "shared/json/document.h"
#include "shared/map/checked_fields.h"
#include "shared/replay/header_reader.h"
#include "shared/replay/line_fields.h"
#include "shared/replay/louse_fields.h"
#include "shared/replay/replay_file.h"

namespace woodlouse::replay {
namespace {

using core::joined;
using map::Fields;
using map::Problems;
using map::Range;

constexpr json::Limits kLimits{8, 4'000'000};
constexpr std::uint64_t kMaxUint32 = std::numeric_limits<std::uint32_t>::max();
constexpr Range kCoordinate{-1e300, 1e300, ""};

template <typename T>
T as(std::optional<std::uint64_t> value) {
  return static_cast<T>(value.value_or(0));
}

// ---- a step ----------------------------------------------------------------------------------------------

std::optional<PlayerLabel> read_label(const Fields& fields, Problems& problems) {
  const auto name = fields.find("name");
  const auto role = fields.find("role");
  if (!name && !role) return std::nullopt;
  PlayerLabel label;
  label.name = demand_text(fields, "name", problems);
  const std::string text = demand_text(fields, "role", problems);
  for (const protocol::Role known :
       {protocol::Role::kPlayer, protocol::Role::kBot, protocol::Role::kSpectator}) {
    if (protocol::to_text(known) == text) {
      label.role = known;
      return label;
    }
  }
  if (role) problems.add(*role, "is no role", "player, bot or spectator");
  return label;
}

void read_change(const json::Value& value, StepLine& line, Problems& problems) {
  using match::RosterAction;
  constexpr std::pair<std::string_view, RosterAction> kActions[] = {
      {"join", RosterAction::kJoin}, {"leave", RosterAction::kLeave}, {"respawn", RosterAction::kRespawn}};
  for (const auto& [key, action] : kActions) {
    const auto player = value.find(key);
    if (!player) continue;
    const bool is_join = action == RosterAction::kJoin;
    const Fields fields =
        is_join ? Fields(value, {key, "name", "role"}, problems) : Fields(value, {key}, problems);
    line.step.roster.push_back(
        {action, as<match::PlayerId>(map::integer_in(*player, 1, kMaxUint32 - 1, problems))});
    line.labels.push_back(is_join ? read_label(fields, problems) : std::nullopt);
    return;
  }
  problems.add(value, "{\"join\": id}, {\"leave\": id} or {\"respawn\": id} is wanted");
}

void read_thrust(const json::Value& value, match::AppliedInput& input, Problems& problems) {
  constexpr Range kUnit{-1.0, 1.0, ""};
  if (value.is(json::Kind::kNull)) return;
  if (value.is(json::Kind::kArray)) {
    input.kind = physics::ThrustKind::kMapVector;
    input.thrust = map::pair_in(value, kUnit, problems).value_or(core::Vec2{});
    if (core::dot(input.thrust, input.thrust) > 1.0) problems.add(value, "is longer than 1");
    return;
  }
  input.kind = physics::ThrustKind::kAlongHeading;
  input.thrust.x = map::number_in(value, kUnit, problems).value_or(0.0);
}

void read_input(const json::Value& value, StepLine& line, Problems& problems) {
  const Fields fields(value, {"player", "seq", "thrust", "ticks", "margin_us"}, problems);
  match::AppliedInput input;
  input.tick = line.step.tick;
  input.player = static_cast<match::PlayerId>(demand_integer(fields, "player", 1, kMaxUint32 - 1, problems));
  input.seq = static_cast<std::uint32_t>(demand_integer(fields, "seq", 0, kMaxUint32, problems));
  input.ticks = physics::kHeld;
  if (const auto ticks = fields.find("ticks")) {
    input.ticks = as<std::uint32_t>(map::integer_in(*ticks, 0, physics::kHeld - 1, problems));
  }
  if (const auto thrust = fields.demand("thrust")) read_thrust(*thrust, input, problems);
  std::optional<std::int64_t> margin;
  if (const auto found = fields.find("margin_us")) {
    margin = found->integer();
    if (!margin) problems.add(*found, "a whole number is wanted");
  }
  line.step.inputs.push_back(input);
  line.margins_us.push_back(margin);
}

/// Calls read(element) for each element of a list; stops at the first problem, of which one is enough.
template <typename Read>
void read_list(const json::Value& value, Problems& problems, const Read& read) {
  if (!value.is(json::Kind::kArray)) return problems.add(value, "a list is wanted");
  for (const json::Value& element : value.children()) {
    if (problems.count() != 0) return;
    read(element);
  }
}

StepLine read_step(const json::Value& root, Problems& problems) {
  const Fields fields(root, {"step", "roster", "inputs", "hash"}, problems);
  StepLine line;
  line.step.tick = demand_integer(fields, "step", 0, kMaxTick, problems);
  line.step.hash = demand_hash(fields, "hash", problems);
  if (const auto roster = fields.find("roster")) {
    read_list(*roster, problems, [&](const json::Value& value) { read_change(value, line, problems); });
  }
  if (const auto inputs = fields.find("inputs")) {
    read_list(*inputs, problems, [&](const json::Value& value) { read_input(value, line, problems); });
  }
  return line;
}

// ---- a keyframe ------------------------------------------------------------------------------------------

physics::Louse read_louse(const json::Value& row, Problems& problems) {
  physics::Louse louse;
  const std::vector<json::Value> values = row.children();
  if (!row.is(json::Kind::kArray) || values.size() != kLouseFields) {
    problems.add(row, joined({"a row of ", std::to_string(kLouseFields), " numbers is wanted"}));
    return louse;
  }
  std::size_t index = 0;
  visit_fields(louse, [&](std::string_view, auto& field) {
    const json::Value& value = values[index++];
    using Field = std::remove_cvref_t<decltype(field)>;
    if constexpr (std::is_same_v<Field, double>) {
      field = map::number_in(value, kCoordinate, problems).value_or(0.0);
    } else {
      const std::uint64_t max = std::is_enum_v<Field> ? std::uint64_t{2} : kMaxUint32;
      field = static_cast<Field>(as<std::uint32_t>(map::integer_in(value, 0, max, problems)));
    }
  });
  return louse;
}

Keyframe read_keyframe(const json::Value& root, Problems& problems) {
  const Fields fields(root, {"keyframe", "columns", "lice"}, problems);
  Keyframe keyframe;
  keyframe.tick = demand_integer(fields, "keyframe", 0, kMaxTick, problems);
  if (const auto columns = fields.demand("columns")) {
    const std::vector<json::Value> names = columns->children();
    std::size_t index = 0;
    bool same = names.size() == kLouseFields;
    visit_fields(physics::Louse{}, [&](std::string_view name, const auto&) {
      same = same && names[index].is(json::Kind::kString) && names[index].text() == name;
      ++index;
    });
    if (!same) problems.add(*columns, "are not the columns of this version");
  }
  const auto lice = fields.demand("lice");
  if (!lice) return keyframe;
  read_list(*lice, problems, [&](const json::Value& row) {
    keyframe.lice.push_back(read_louse(row, problems));
    const std::size_t count = keyframe.lice.size();
    if (count > 1 && keyframe.lice[count - 1].id <= keyframe.lice[count - 2].id) {
      problems.add(row, "does not follow the id before it");
    }
  });
  return keyframe;
}

// ---- any line --------------------------------------------------------------------------------------------

ChatLine read_chat(const json::Value& root, Problems& problems) {
  const Fields fields(root, {"chat", "player", "name", "text"}, problems);
  ChatLine line;
  line.tick = demand_integer(fields, "chat", 0, kMaxTick, problems);
  line.player = static_cast<match::PlayerId>(demand_integer(fields, "player", 0, kMaxUint32, problems));
  line.name = demand_text(fields, "name", problems);
  line.text = demand_text(fields, "text", problems);
  return line;
}

End read_end(const json::Value& root, Problems& problems) {
  const Fields fields(root, {"end", "reason"}, problems);
  End end;
  end.tick = demand_integer(fields, "end", 0, kMaxTick, problems);
  end.reason = demand_text(fields, "reason", problems);
  return end;
}

Line read_object(const json::Value& root, Problems& problems) {
  if (root.find("step")) return read_step(root, problems);
  if (root.find("keyframe")) return read_keyframe(root, problems);
  if (root.find("chat")) return read_chat(root, problems);
  if (root.find("end")) return read_end(root, problems);
  problems.add(root, "is no step, keyframe, chat or end");
  return End{};
}

}  // namespace

core::Expected<bool> ReplayReader::read_line() {
  line_.clear();
  std::streambuf& bytes = *in_.rdbuf();
  for (int c = bytes.sbumpc(); c != std::char_traits<char>::eof(); c = bytes.sbumpc()) {
    if (c == '\n') {
      ++line_number_;
      return true;
    }
    if (line_.size() >= kMaxReplayLineBytes) {
      return core::fail(joined({source_, ":", std::to_string(line_number_ + 1)}),
                        joined({"a line longer than ", std::to_string(kMaxReplayLineBytes >> 20), " MiB"}));
    }
    line_ += static_cast<char>(c);
  }
  cut_off_ = !line_.empty();
  return false;
}

core::Expected<Header> ReplayReader::read_header() {
  const core::Expected<bool> whole = read_line();
  if (!whole) return tl::unexpected(whole.error());
  if (!*whole)
    return core::fail(source_,
                      line_.empty() ? "is empty" : "has no whole line: it was cut off in the header");
  const auto document = json::parse_file(line_, source_, kLimits, line_number_);
  if (!document) return tl::unexpected(document.error());
  Problems problems(source_);
  Header header = replay::read_header(document->root(), problems);
  if (problems.count() != 0) return tl::unexpected(problems.errors().front());
  return header;
}

core::Expected<std::optional<Line>> ReplayReader::next() {
  const core::Expected<bool> whole = read_line();
  if (!whole) return tl::unexpected(whole.error());
  if (!*whole) return std::optional<Line>();
  const auto document = json::parse_file(line_, source_, kLimits, line_number_);
  if (!document) return tl::unexpected(document.error());
  Problems problems(source_);
  Line line = read_object(document->root(), problems);
  if (problems.count() != 0) return tl::unexpected(problems.errors().front());
  return std::optional<Line>(std::move(line));
}

}  // namespace woodlouse::replay
