#include "client/play/roster.h"

#include <string>
#include <utility>

#include "shared/core/joined.h"

namespace woodlouse::client {

std::string describe(const protocol::Event& event) {
  switch (event.kind) {
    case protocol::EventKind::kJoined:
      if (event.role == protocol::Role::kSpectator) return event.name + " watches";
      return (event.role == protocol::Role::kBot ? "bot " : "") + event.name + " joined";
    case protocol::EventKind::kLeft:
      return event.name + " left";
    case protocol::EventKind::kChat:
      return event.text;
    case protocol::EventKind::kRespawned:
      return event.name + " starts again";
    case protocol::EventKind::kSkip:
      return core::joined({event.name,
                           " votes for the next game (/skip): ", std::to_string(event.values[0].value_or(0)),
                           " of ", std::to_string(event.values[1].value_or(0))});
    default:
      return {};  // of the rules: goal.h
  }
}

void Roster::welcome(const protocol::Welcome& welcome) {
  residents_.clear();
  for (const protocol::PlayerEntry& player : welcome.players) {
    if (player.id != 0) residents_[player.id] = {player.name, player.role};
  }
  if (welcome.id != 0 && !welcome.name.empty())
    residents_[welcome.id] = {welcome.name, protocol::Role::kPlayer};
  spectators_ = welcome.spectators;
}

void Roster::event(const protocol::Event& event) {
  if (event.id != 0 && event.kind == protocol::EventKind::kJoined)
    residents_[event.id] = {event.name, event.role};
  if (event.id != 0 && event.kind == protocol::EventKind::kLeft) residents_.erase(event.id);
  const std::string told = describe(event);
  if (!told.empty()) say(event.kind == protocol::EventKind::kChat ? event.name : std::string(), told);
}

const Resident* Roster::find(std::uint32_t id) const {
  const auto found = residents_.find(id);
  return found == residents_.end() ? nullptr : &found->second;
}

void Roster::say(std::string from, std::string text) {
  chat_.push_back({std::move(from), std::move(text)});
  if (chat_.size() > kLines) chat_.pop_front();
  ++lines_said_;
}

}  // namespace woodlouse::client
