// Who is in a room: sessions, the house's own bots, and lice whose player is only in the recording that the
// game goes on from. Each has a seat. Pure. The room's strand owns it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "server/room/channels.h"
#include "server/room/house_bots.h"
#include "server/room/subscriber.h"
#include "shared/match/match.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// Its player is only in the recording. Whoever joins under its name takes it over.
struct Nobody {};

/// A connection.
struct SessionOccupant {
  SessionId session = 0;
  std::shared_ptr<Subscriber> subscriber;
  ChannelId channel = 0;
  std::uint64_t acked_from = 0;  ///< the tick from which on all its inputs are acknowledged
};

/// One of the house's bots, counted from 0.
struct BotOccupant {
  std::uint32_t number = 0;
  HouseBot bot;
};

struct Seat {
  match::PlayerId louse = 0;  ///< 0: a spectator
  std::string name;           ///< cleaned, not empty
  protocol::Role role = protocol::Role::kPlayer;
  /// What the match adds to its occupant's own count of inputs, as a louse taken over has used some; of a
  /// bot, the last one it used.
  std::uint32_t first_seq = 0;
  std::variant<Nobody, BotOccupant, SessionOccupant> occupant;
};

class Seats {
 public:
  /// Unclaimed seats; each has a louse.
  explicit Seats(std::vector<Seat> unclaimed);

  /// REQUIRES that its occupant (or its louse, where it is nobody's) has no seat yet. The seat stays where it
  /// is until it is taken away.
  Seat& add(Seat seat);
  /// The first unclaimed seat of that name, which is gone from here; nothing where there is none.
  std::optional<Seat> take_over(std::string_view name);
  /// The session's seat, which is gone from here; nothing where it has none.
  std::optional<Seat> take_away(SessionId session);
  /// Every session's.
  std::vector<Seat> take_away_sessions();

  /// The session's, or null.
  [[nodiscard]] Seat* find(SessionId session);
  [[nodiscard]] std::size_t sessions() const { return sessions_; }
  /// Unclaimed seats first, by louse, then the house's bots, then sessions by number.
  [[nodiscard]] std::vector<protocol::PlayerEntry> entries() const;

  /// Calls visit(Seat&, Occupant&) for each that such an occupant has, in the order of entries().
  template <typename Occupant, typename Visit>
  void for_each(const Visit& visit) {
    constexpr std::size_t kind = std::is_same_v<Occupant, Nobody>        ? 0
                                 : std::is_same_v<Occupant, BotOccupant> ? 1
                                                                         : 2;
    static_assert(std::is_same_v<std::variant_alternative_t<kind, decltype(Seat::occupant)>, Occupant>);
    const auto end = seats_.lower_bound({kind + 1, 0});
    for (auto at = seats_.lower_bound({kind, 0}); at != end; ++at)
      visit(at->second, std::get<Occupant>(at->second.occupant));
  }

 private:
  using Place = std::pair<std::size_t, std::uint64_t>;  ///< kind of occupant, its number
  static Place place_of(const Seat& seat);

  std::map<Place, Seat> seats_;
  std::size_t sessions_ = 0;
};

}  // namespace woodlouse::server
