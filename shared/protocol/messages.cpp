#include "shared/protocol/messages.h"

#include <array>
#include <cassert>

namespace woodlouse::protocol {
namespace {

struct EventEntry {
  std::string_view name;
  std::array<std::string_view, kMostEventValues> values{};
  std::size_t count = 0;
};

template <typename... Names>
consteval EventEntry event(std::string_view name, Names... values) {
  return {name, {values...}, sizeof...(values)};
}

// In the order of EventKind.
constexpr std::array<EventEntry, kEventKindCount> kEvents = {
    {event("joined"), event("left"), event("chat"), event("respawned"),
     event("gate", "gate", "lap", "split", "delta"), event("lap", "lap", "time", "best"),
     event("run", "time", "rank", "ranked"), event("crumb", "slot", "value", "chain", "score"),
     event("harvest"), event("bump", "other", "impulse"), event("holds"), event("contested"),
     event("moving", "place", "at"), event("fell", "by"), event("returned"), event("round", "round", "until"),
     event("record", "time", "bots"), event("skip", "votes", "needed")}};

}  // namespace

std::string_view to_text(Format format) { return format == Format::kExact ? "exact" : "quantized"; }

std::string_view to_text(Stream stream) { return stream == Stream::kInputs ? "inputs" : "frames"; }

std::string_view to_text(Role role) {
  switch (role) {
    case Role::kPlayer:
      return "player";
    case Role::kBot:
      return "bot";
    case Role::kSpectator:
      return "spectator";
  }
  return "player";
}

std::optional<Role> role_from_text(std::string_view text) {
  for (const Role role : {Role::kPlayer, Role::kBot, Role::kSpectator}) {
    if (to_text(role) == text) return role;
  }
  return std::nullopt;
}

std::string_view to_text(EventKind kind) { return kEvents[static_cast<std::size_t>(kind)].name; }

std::optional<EventKind> event_kind_from_text(std::string_view text) {
  for (std::size_t k = 0; k < kEvents.size(); ++k) {
    if (kEvents[k].name == text) return static_cast<EventKind>(k);
  }
  return std::nullopt;
}

std::span<const std::string_view> value_names(EventKind kind) {
  const EventEntry& event = kEvents[static_cast<std::size_t>(kind)];
  return std::span(event.values).first(event.count);
}

}  // namespace woodlouse::protocol
