#include "server/room/seats.h"

#include <algorithm>
#include <cassert>
#include <type_traits>
#include <utility>

#include "shared/protocol/text_cleaning.h"

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
    assert(seat.louse != 0 &&
           (std::holds_alternative<Nobody>(seat.occupant) || std::holds_alternative<Vacant>(seat.occupant)));
    add(std::move(seat));
  }
}

Seat& Seats::add(Seat seat) {
  assert(!seat.name.empty());
  const Place place = place_of(seat);
  const bool is_session = std::holds_alternative<SessionOccupant>(seat.occupant);
  sessions_ += is_session ? 1 : 0;
  if (is_session && seat.role == protocol::Role::kPlayer) ++players_of_[seat.address];
  vacant_ += std::holds_alternative<Vacant>(seat.occupant) ? 1 : 0;
  names_.insert(seat.name);
  assert(!seat.token || seat.claim);
  if (seat.claim) tokens_.emplace(*seat.claim, place);
  const auto [at, is_new] = seats_.emplace(place, std::move(seat));
  assert(is_new);
  return at->second;
}

Seat Seats::take(std::map<Place, Seat>::iterator at) {
  Seat seat = std::move(at->second);
  seats_.erase(at);
  const bool is_session = std::holds_alternative<SessionOccupant>(seat.occupant);
  sessions_ -= is_session ? 1 : 0;
  if (is_session && seat.role == protocol::Role::kPlayer) {
    const auto own = players_of_.find(seat.address);
    assert(own != players_of_.end());
    if (--own->second == 0) players_of_.erase(own);
  }
  vacant_ -= std::holds_alternative<Vacant>(seat.occupant) ? 1 : 0;
  const auto name = names_.find(seat.name);
  assert(name != names_.end());
  names_.erase(name);
  if (seat.claim) tokens_.erase(*seat.claim);
  return seat;
}

std::optional<Seat> Seats::take_over(std::string_view name) {
  const auto found = std::find_if(seats_.begin(), seats_.end(), [name](const auto& entry) {
    return std::holds_alternative<Nobody>(entry.second.occupant) && entry.second.name == name;
  });
  if (found == seats_.end()) return std::nullopt;
  return take(found);
}

std::optional<Seat> Seats::take_back(const TokenDigest& token) {
  const auto place = tokens_.find(token);
  if (place == tokens_.end()) return std::nullopt;
  return take(seats_.find(place->second));
}

Seat Seats::take_vacant(match::PlayerId louse) {
  const auto found = seats_.find({3, louse});
  assert(found != seats_.end() && std::holds_alternative<Vacant>(found->second.occupant));
  return take(found);
}

Seat Seats::take_away(const Seat& seat) {
  const auto found = seats_.find(place_of(seat));
  assert(found != seats_.end() && &found->second == &seat);
  return take(found);
}

std::optional<Seat> Seats::take_away(SessionId session) {
  const auto found = seats_.find(session_place(session));
  if (found == seats_.end()) return std::nullopt;
  return take(found);
}

std::vector<Seat> Seats::take_away_sessions() {
  std::vector<Seat> taken;
  for (auto at = seats_.begin(); at != seats_.end();) {
    const auto here = at++;
    if (std::holds_alternative<SessionOccupant>(here->second.occupant)) taken.push_back(take(here));
  }
  assert(sessions_ == 0);
  return taken;
}

bool Seats::all_rest(const physics::World& world) {
  const auto is_on = [](const state::Louse& louse) {
    const bool counts_down = louse.thrust_ticks != 0 && louse.thrust_ticks != state::kHeld;
    return louse.phase != state::Phase::kResting || counts_down;
  };
  const auto lice = world.lice();
  std::ptrdiff_t on = std::count_if(lice.begin(), lice.end(), is_on);
  for_each<BotOccupant>([&](const Seat& seat, const BotOccupant&) {
    const state::Louse* louse = world.find(seat.louse);
    if (louse != nullptr && is_on(*louse)) --on;
  });
  assert(on >= 0);
  return on == 0;
}

void Seats::move_to(const match::Match& former, match::Match& next) {
  assert(former.settings().tick_hz == next.settings().tick_hz);
  const auto before = std::exchange(seats_, {});
  names_.clear();
  tokens_.clear();
  players_of_.clear();
  sessions_ = vacant_ = 0;
  for (const auto& [place, had] : before) {
    Seat seat = had;
    auto* session = std::get_if<SessionOccupant>(&seat.occupant);
    auto* vacant = std::get_if<Vacant>(&seat.occupant);
    if (session == nullptr && vacant == nullptr) continue;
    if (session != nullptr) session->acked_from = 0;
    if (vacant != nullptr)
      vacant->until = next.tick() + vacant->until - std::min(vacant->until, former.tick());
    seat.next_seq = seat.dropped_below = 0;
    if (seat.louse != 0) seat.louse = next.join({seat.name, seat.role});
    add(std::move(seat));
  }
}

Seat* Seats::find(SessionId session) {
  const auto found = seats_.find(session_place(session));
  return found == seats_.end() ? nullptr : &found->second;
}

std::vector<protocol::PlayerEntry> Seats::entries() const {
  std::vector<protocol::PlayerEntry> entries;
  for (const auto& [place, seat] : seats_)
    if (seat.louse != 0) entries.push_back({seat.louse, seat.name, seat.role});
  return entries;
}

std::vector<RosterEntry> Seats::roster(Time now) const {
  using Kind = RosterEntry::Kind;
  std::vector<RosterEntry> roster;
  for (const auto& [place, seat] : seats_) {
    const auto* session = std::get_if<SessionOccupant>(&seat.occupant);
    const Kind kind = session != nullptr                                   ? Kind::kSession
                      : std::holds_alternative<BotOccupant>(seat.occupant) ? Kind::kHouse
                                                                           : Kind::kAway;
    roster.push_back({kind, session != nullptr ? session->session : 0, seat.louse, seat.name, seat.role,
                      seat.muted_until > now});
  }
  return roster;
}

Seat* Seats::find(const RosterEntry& entry) {
  if (entry.session != 0)
    if (Seat* seat = find(entry.session)) return seat;
  // He may have come back since over another connection, or gone for a while.
  for (auto& [place, seat] : seats_)
    if (seat.louse != 0 && seat.louse == entry.louse && seat.name == entry.name) return &seat;
  return nullptr;
}

std::string Seats::free_name(std::string_view name, std::uint64_t number) const {
  constexpr std::uint64_t kTried = 9;  // of many of one name each would look through all of them
  const auto numbered = [name](std::uint64_t n) {
    const std::string tail = '#' + std::to_string(n);
    return protocol::clean_text(name, protocol::kMaxNameBytes - tail.size()) + tail;
  };
  if (!names_.contains(name)) return std::string(name);
  for (std::uint64_t n = 2; n <= kTried; ++n)
    if (std::string other = numbered(n); !names_.contains(other)) return other;
  for (std::uint64_t n = std::max(number, kTried + 1);; ++n)
    if (std::string other = numbered(n); !names_.contains(other)) return other;
}

}  // namespace woodlouse::server
