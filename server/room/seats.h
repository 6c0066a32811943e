// Who is in a room: sessions, the house's own bots, lice whose player is only in the recording that the game
// goes on from, and those whose player may come back. Each has a seat. Pure. The room's strand owns it.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "server/access/claim.h"
#include "server/access/resume_token.h"
#include "server/frames/layouts.h"
#include "server/room/house_bots.h"
#include "server/room/subscriber.h"
#include "server/timing/clock.h"
#include "shared/match/match.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// Its player is only in the recording.
struct Nobody {};

/// A connection.
struct SessionOccupant {
  SessionId session = 0;
  std::shared_ptr<Subscriber> subscriber;
  ChannelId channel = 0;
  std::uint64_t acked_from = 0;  ///< the tick from which on all its inputs are acknowledged
  std::uint32_t state_hz = 0;    ///< granted to it
  /// Who asked to watch by inputs: what his rows are where a game can't be watched so.
  std::optional<RowLayout> rows_instead{};
};

/// One of the house's bots, counted from 0.
struct BotOccupant {
  std::uint32_t number = 0;
  HouseBot bot;
};

/// Its player's connection has ended, and it may come back until that tick.
struct Vacant {
  std::uint64_t until = 0;
};

/// Of a seat, what an operator is told.
struct RosterEntry {
  enum class Kind : std::uint8_t { kSession, kHouse, kAway };  ///< kAway: nobody sits there now
  Kind kind = Kind::kSession;
  SessionId session = 0;      ///< 0: none
  match::PlayerId louse = 0;  ///< 0: a spectator
  std::string name;
  protocol::Role role = protocol::Role::kPlayer;
  bool is_muted = false;
};

struct Seat {
  match::PlayerId louse = 0;  ///< 0: a spectator
  std::string name;           ///< cleaned, not empty
  protocol::Role role = protocol::Role::kPlayer;
  /// Under which the match files its next input, whatever its occupants count: each begins anew.
  std::uint32_t next_seq = 0;
  std::variant<Nobody, BotOccupant, SessionOccupant, Vacant> occupant;
  AddressId address = 0;  ///< of its session, or of the one it had
  /// By which its player comes back; none: it never asked to, or (claim) another server gave it.
  std::optional<ResumeToken> token{};
  std::optional<TokenDigest> claim{};       ///< of the token; by it the seat is found
  std::optional<std::uint32_t> last_seq{};  ///< of its session's own count
  std::uint32_t dropped_below = 0;  ///< inputs that were filed under less, and not taken, never will be
  Time muted_until{};               ///< by an operator; also when its player comes back
  std::uint64_t mute_ends = 0;      ///< the same by the calendar, as a Claim has it
};

/// REQUIRES that it has one.
[[nodiscard]] inline Claim claim_of(const Seat& seat) {
  assert(seat.claim && seat.louse != 0);
  return {seat.louse, seat.name, seat.role, *seat.claim, seat.mute_ends};
}

class Seats {
 public:
  /// Unclaimed seats and vacant ones; each has a louse.
  explicit Seats(std::vector<Seat> unclaimed);

  /// REQUIRES that its occupant (or its louse, where it is nobody's) has no seat yet. The seat stays where it
  /// is until it is taken away.
  Seat& add(Seat seat);
  /// The first unclaimed seat of that name, which is gone from here; nothing where there is none.
  std::optional<Seat> take_over(std::string_view name);
  /// The seat, of a session or vacant, of that token, which is gone from here; nothing where there is none.
  std::optional<Seat> take_back(const TokenDigest& token);
  /// The vacant seat of a louse that nobody comes back to, which is gone from here. REQUIRES that there is
  /// one.
  Seat take_vacant(match::PlayerId louse);
  /// One of these, which is gone from here.
  Seat take_away(const Seat& seat);
  /// Nobody comes back to it any more.
  void forget_token(Seat& seat) {
    if (seat.claim) tokens_.erase(*std::exchange(seat.claim, std::nullopt));
    seat.token.reset();
  }
  /// The session's seat, which is gone from here; nothing where it has none.
  std::optional<Seat> take_away(SessionId session);
  /// Another game begins: who is here, or may come back, joins it under his name; the house's bots and who is
  /// only in a recording are here no more. REQUIRES that both matches have one tick rate.
  void move_to(const match::Match& former, match::Match& next);
  /// Every session's.
  std::vector<Seat> take_away_sessions();

  /// The session's, or null.
  [[nodiscard]] Seat* find(SessionId session);
  [[nodiscard]] std::size_t sessions() const { return sessions_; }
  [[nodiscard]] std::size_t vacant() const { return vacant_; }
  /// From which players' sessions come; who may come back is not here.
  [[nodiscard]] std::size_t player_addresses() const { return players_of_.size(); }
  /// No louse moves, and no thrust counts down, but of the house's bots.
  [[nodiscard]] bool all_rest(const physics::World& world);
  struct VacantSeats {
    std::size_t count = 0;
    match::PlayerId oldest = 0;  ///< the louse of the one given up first
  };
  /// Those of which is_meant(const Seat&).
  template <typename IsMeant>
  [[nodiscard]] VacantSeats vacant_seats(const IsMeant& is_meant) {
    VacantSeats found;
    std::uint64_t until = 0;
    if (vacant_ == 0) return found;
    for_each<Vacant>([&](const Seat& seat, const Vacant& vacant) {
      if (!is_meant(seat)) return;
      if (found.count++ != 0 && vacant.until >= until) return;
      until = vacant.until;
      found.oldest = seat.louse;
    });
    return found;
  }
  /// Who has a louse: unclaimed seats first, by louse, then the house's bots, then sessions by number, then
  /// vacant ones by louse.
  [[nodiscard]] std::vector<protocol::PlayerEntry> entries() const;
  /// Everybody, in the order of entries().
  [[nodiscard]] std::vector<RosterEntry> roster(Time now) const;
  /// Whose that entry was, if he has not gone or become another one since; or null.
  [[nodiscard]] Seat* find(const RosterEntry& entry);
  /// The name, or, where another one has it, that with a number behind: of `number` at the latest.
  [[nodiscard]] std::string free_name(std::string_view name, std::uint64_t number) const;

  /// Calls visit(Seat&, Occupant&) for each that such an occupant has, in the order of entries().
  template <typename Occupant, typename Visit>
  void for_each(const Visit& visit) {
    constexpr std::size_t kind = std::is_same_v<Occupant, Nobody>            ? 0
                                 : std::is_same_v<Occupant, BotOccupant>     ? 1
                                 : std::is_same_v<Occupant, SessionOccupant> ? 2
                                                                             : 3;
    static_assert(std::is_same_v<std::variant_alternative_t<kind, decltype(Seat::occupant)>, Occupant>);
    const auto end = seats_.lower_bound({kind + 1, 0});
    for (auto at = seats_.lower_bound({kind, 0}); at != end; ++at)
      visit(at->second, std::get<Occupant>(at->second.occupant));
  }

 private:
  using Place = std::pair<std::size_t, std::uint64_t>;  ///< kind of occupant, its number
  static Place place_of(const Seat& seat);
  Seat take(std::map<Place, Seat>::iterator at);

  std::map<Place, Seat> seats_;
  std::multiset<std::string, std::less<>> names_;
  std::map<TokenDigest, Place> tokens_;
  std::size_t sessions_ = 0;
  std::size_t vacant_ = 0;
  std::map<AddressId, std::size_t> players_of_;  ///< sessions of players, by their address
};

}  // namespace woodlouse::server
