#include "server/room/seats.h"

#include <algorithm>
#include <cassert>
#include <type_traits>

namespace woodlouse::server {
namespace {

std::pair<std::size_t, std::uint64_t> session_place(SessionId session) {
  constexpr std::size_t kKind = 2;  // of SessionOccupant among the occupants
  static_assert(std::is_same_v<std::variant_alternative_t<kKind, decltype(Seat::occupant)>, SessionOccupant>);
  return {kKind, session};
}

}  // namespace

Seats::Place Seats::place_of(const Seat& seat) {
  const std::size_t kind = seat.occupant.index();
  if (const auto* session = std::get_if<SessionOccupant>(&seat.occupant)) return {kind, session->session};
  if (const auto* bot = std::get_if<BotOccupant>(&seat.occupant)) return {kind, bot->number};
  return {kind, seat.louse};
}

Seats::Seats(std::vector<Seat> unclaimed) {
  for (Seat& seat : unclaimed) {
    assert(std::holds_alternative<Nobody>(seat.occupant) && seat.louse != 0);
    add(std::move(seat));
  }
}

Seat& Seats::add(Seat seat) {
  assert(!seat.name.empty());
  if (std::holds_alternative<SessionOccupant>(seat.occupant)) ++sessions_;
  const Place place = place_of(seat);
  const auto [at, is_new] = seats_.emplace(place, std::move(seat));
  assert(is_new);
  return at->second;
}

std::optional<Seat> Seats::take_over(std::string_view name) {
  const auto found = std::find_if(seats_.begin(), seats_.end(), [name](const auto& entry) {
    return std::holds_alternative<Nobody>(entry.second.occupant) && entry.second.name == name;
  });
  if (found == seats_.end()) return std::nullopt;
  return std::move(seats_.extract(found).mapped());
}

std::optional<Seat> Seats::take_away(SessionId session) {
  auto node = seats_.extract(session_place(session));
  if (node.empty()) return std::nullopt;
  --sessions_;
  return std::move(node.mapped());
}

std::vector<Seat> Seats::take_away_sessions() {
  std::vector<Seat> taken;
  for (auto at = seats_.begin(); at != seats_.end();) {
    const auto here = at++;
    if (!std::holds_alternative<SessionOccupant>(here->second.occupant)) continue;
    taken.push_back(std::move(here->second));
    seats_.erase(here);
  }
  assert(taken.size() == sessions_);
  sessions_ = 0;
  return taken;
}

Seat* Seats::find(SessionId session) {
  const auto found = seats_.find(session_place(session));
  return found == seats_.end() ? nullptr : &found->second;
}

std::vector<protocol::PlayerEntry> Seats::entries() const {
  std::vector<protocol::PlayerEntry> entries;
  entries.reserve(seats_.size());
  for (const auto& [place, seat] : seats_) entries.push_back({seat.louse, seat.name, seat.role});
  return entries;
}

}  // namespace woodlouse::server
