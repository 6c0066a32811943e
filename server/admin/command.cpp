#include "server/admin/command.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "server/access/secret.h"
#include "shared/core/joined.h"
#include "shared/json/object_text.h"
#include "shared/protocol/codes.h"
#include "shared/protocol/field_reader.h"
#include "shared/protocol/field_texts.h"
#include "shared/protocol/line_object.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {
namespace {

using protocol::DecodeError;
using protocol::FieldReader;
using protocol::Presence;

/// Fields of a verb, each with whether it must be there.
struct Taken {
  std::string_view name;
  Presence presence = Presence::kOptional;
};

struct VerbEntry {
  Verb verb;
  std::array<Taken, 3> takes{};  ///< those without a name are none
};

constexpr Taken kWho{"who", Presence::kRequired};
constexpr Taken kRoom{"room"};
constexpr Taken kSeconds{"seconds"};

constexpr std::array<std::pair<std::string_view, VerbEntry>, 18> kVerbs = {{
    {"status", {Verb::kStatus}},
    {"rooms", {Verb::kRooms, {{kRoom}}}},
    {"open", {Verb::kOpen, {{{"file", Presence::kRequired}, {"name"}}}}},
    {"close", {Verb::kClose, {{{"room", Presence::kRequired}}}}},
    {"kick", {Verb::kKick, {{kWho, kRoom}}}},
    {"ban", {Verb::kBan, {{kWho, kSeconds}}}},
    {"unban", {Verb::kUnban, {{kWho}}}},
    {"bans", {Verb::kBans}},
    {"mute", {Verb::kMute, {{kWho, kRoom, kSeconds}}}},
    {"unmute", {Verb::kUnmute, {{kWho, kRoom}}}},
    {"say", {Verb::kSay, {{{"text", Presence::kRequired}, kRoom}}}},
    {"pause", {Verb::kPause, {{kRoom}}}},
    {"resume", {Verb::kResume, {{kRoom}}}},
    {"step", {Verb::kStep, {{kRoom, {"ticks"}}}}},
    {"record", {Verb::kRecord, {{{"on", Presence::kRequired}, kRoom}}}},
    {"reload", {Verb::kReload}},
    {"drain", {Verb::kDrain, {{kSeconds}}}},
    {"shutdown", {Verb::kShutdown}},
}};

/// As it was said: a path may be named in any way.
void read_path(FieldReader& reader, std::string& path, Presence presence) {
  constexpr std::string_view kWants = "a path of at most 4096 bytes";
  const auto value = reader.field("file", kWants, presence);
  if (!value) return;
  const bool is_path = value->is(json::Kind::kString) && !value->text().empty() &&
                       value->text().size() <= kMostPathBytes &&
                       value->text().find('\0') == std::string_view::npos;
  if (!is_path) return reader.refuse("file", *value, kWants);
  path = value->text();
}

/// Where something must be named, something is left of it once it is cleaned.
void read_name(FieldReader& reader, const Taken& taken, std::string& name, std::size_t most) {
  reader.key_text(taken.name, name, most, taken.presence);
  if (taken.presence == Presence::kRequired && !reader.failed() && name.empty())
    reader.fail(protocol::code::kBadField,
                core::joined({taken.name, " is empty, or nothing of it can be seen"}));
}

void read_taken(FieldReader& reader, const Taken& taken, Command& command) {
  const auto [name, presence] = taken;
  if (name == "who") return read_name(reader, taken, command.who, kMostWhoBytes);
  if (name == "room") return read_name(reader, taken, command.room, protocol::kMaxRoomBytes);
  if (name == "name") return reader.key_text(name, command.name, protocol::kMaxRoomBytes, presence);
  if (name == "text") return reader.cleaned_text(name, command.text, {1, protocol::kMaxChatBytes}, presence);
  if (name == "file") return read_path(reader, command.file, presence);
  if (name == "ticks") return reader.integer(name, command.ticks, {1, kMostSteps}, presence);
  if (name == "on") return reader.boolean(name, command.on, presence);
  assert(name == "seconds");
  // Nobody is banned for no time; drained at once may be.
  const bool drains = command.verb == Verb::kDrain;
  reader.integer(name, command.seconds,
                 {drains ? 0 : 1, static_cast<std::int64_t>(drains ? kMostDrainSeconds : kMostSeconds)});
}

/// A slip in a field's name must not make a ban without an end of one for an hour.
void refuse_unknown(FieldReader& reader, const json::Value& object, const VerbEntry& entry) {
  object.for_each([&](const json::Value& member) {
    const std::string_view key = member.key();
    const auto is_it = [key](const Taken& taken) { return !taken.name.empty() && taken.name == key; };
    if (key == "type" || key == "token" || std::any_of(entry.takes.begin(), entry.takes.end(), is_it))
      return true;
    std::string takes;
    for (const Taken& taken : entry.takes)
      if (!taken.name.empty()) takes += core::joined({takes.empty() ? "" : ", ", taken.name});
    reader.fail(protocol::code::kBadField,
                core::joined({to_text(entry.verb), " has no field ", json::shown(key), "; it takes ",
                              takes.empty() ? "none" : takes}));
    return false;
  });
}

}  // namespace

std::string_view to_text(Verb verb) {
  const auto index = static_cast<std::size_t>(verb);
  assert(index < kVerbs.size() && kVerbs[index].second.verb == verb);
  return kVerbs[index].first;
}

tl::expected<AdminLine, DecodeError> decode_command(std::string_view text) {
  const auto document = protocol::parse_object(text);
  if (!document) return tl::unexpected(document.error());
  const auto type = protocol::read_type(*document, kVerbs);
  if (!type) return tl::unexpected(type.error());
  const VerbEntry& entry = (*type)->second;
  AdminLine line;
  line.command.verb = entry.verb;
  FieldReader reader(document->root(), std::string((*type)->first));
  reader.key_text("token", line.token, kMostSecretBytes, Presence::kOptional);
  refuse_unknown(reader, document->root(), entry);
  for (const Taken& taken : entry.takes)
    if (!taken.name.empty()) read_taken(reader, taken, line.command);
  return reader.finish<AdminLine>(std::move(line));
}

std::string encode(const AdminLine& line) {
  const Command& command = line.command;
  std::string out;
  json::ObjectText object(out, to_text(command.verb));
  if (!line.token.empty()) object.text("token", line.token);
  if (!command.who.empty()) object.text("who", command.who);
  if (!command.room.empty()) object.text("room", command.room);
  if (!command.file.empty()) object.text("file", command.file);
  if (!command.name.empty()) object.text("name", command.name);
  if (!command.text.empty()) object.text("text", command.text);
  if (command.seconds) object.integer("seconds", *command.seconds);
  if (command.verb == Verb::kStep) object.integer("ticks", command.ticks);
  if (command.verb == Verb::kRecord) object.boolean("on", command.on);
  object.end_line();
  return out;
}

}  // namespace woodlouse::server
