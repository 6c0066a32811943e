#include "server/room/input_desk.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "shared/core/joined.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

namespace code = protocol::code;
using std::chrono::duration_cast;
using std::chrono::microseconds;

protocol::ErrorMessage why_dropped(std::string_view code, std::string text) {
  return {std::string(code), std::move(text), false, {}};
}

}  // namespace

void InputDesk::file(Seat& seat, SessionOccupant& occupant, const protocol::Input& input, Time arrived) {
  if (seat.louse != 0 && seat.last_seq && input.seq <= *seat.last_seq)
    return drop(occupant, input, {match::Filed::Outcome::kStaleSeq, game_.tick()});
  const std::uint32_t seq = seat.next_seq;
  match::Filed filed =
      game_.file({seat.louse, seq, input.thrust, input.ticks.value_or(state::kHeld), input.tick.value_or(0)},
                 settings_.limits.inputs_per_tick);
  filed.late |= input.tick == 0u && game_.tick() > 0;  // to the match 0 is no wish
  if (filed.outcome != match::Filed::Outcome::kFiled) return drop(occupant, input, filed);
  ++seat.next_seq;
  seat.last_seq = input.seq;
  const std::uint64_t ticks_late = filed.late ? filed.tick - input.tick.value_or(filed.tick) : 0;
  occupant.acked_from = std::max(occupant.acked_from, filed.tick + 1);
  const PendingAck ack{occupant.session, seat.louse, input.seq,     seq,
                       arrived,          filed.late, input.clamped, ticks_late};
  if (filed.replaced) return replace(occupant, filed, ack);
  acks_.add(filed.tick, ack);
}

/// The step takes no more of his: the last one gave way to this one.
void InputDesk::replace(SessionOccupant& occupant, const match::Filed& filed, const PendingAck& newer) {
  PendingAck* const older = acks_.find(filed.tick, newer.player, *filed.replaced);
  if (older == nullptr) return acks_.add(filed.tick, newer);  // of the one who had the louse before
  protocol::Ack ack;
  ack.seq = older->seq;
  ack.tick = game_.tick();
  ack.late = older->late;
  ack.dropped = true;
  ack.clamped = older->clamped;
  occupant.subscriber->answer(why_dropped(
      code::kQueueFull, core::joined({"input ", std::to_string(older->seq), " dropped: a step takes ",
                                      std::to_string(settings_.limits.inputs_per_tick),
                                      " of a player's, and a later one came for it"})));
  occupant.subscriber->answer(ack);
  *older = newer;
}

void InputDesk::drop(SessionOccupant& occupant, const protocol::Input& input, const match::Filed& filed) {
  const std::string where = "input " + std::to_string(input.seq) + " dropped: ";
  Subscriber& subscriber = *occupant.subscriber;
  switch (filed.outcome) {
    case match::Filed::Outcome::kFiled:
      return;
    case match::Filed::Outcome::kStaleSeq:
      // No ack: it would be taken for that of the input that came first under this seq.
      return subscriber.answer(
          why_dropped(code::kStaleSeq, where + "seq must be above that of every input before"));
    case match::Filed::Outcome::kQueueFull:
      subscriber.answer(
          why_dropped(code::kQueueFull, core::joined({where, std::to_string(match::InputQueue::kMaxPending),
                                                      " of your inputs wait, or for that step ",
                                                      std::to_string(settings_.limits.inputs_per_tick)})));
      break;
    case match::Filed::Outcome::kTooFar:
      subscriber.answer(why_dropped(code::kTooFar, where + "tick " + std::to_string(filed.tick) +
                                                       " is more than 2 s after the present " +
                                                       std::to_string(game_.tick())));
      break;
    case match::Filed::Outcome::kNoLouse:
      subscriber.answer(why_dropped(code::kNoLouse, where + "you have no louse"));
      break;
  }
  protocol::Ack ack;
  ack.seq = input.seq;
  ack.tick = game_.tick();
  ack.late = filed.late;
  ack.dropped = true;
  ack.clamped = input.clamped;
  subscriber.answer(ack);
}

/// Its player is not there to steer: the thrust ends, and none of what waits begins another.
void InputDesk::stop(Seat& seat) {
  assert(seat.louse != 0);
  const state::Louse* louse = game_.world().find(seat.louse);
  std::set<std::uint64_t> ticks;
  if (louse != nullptr && louse->thrust_kind != state::ThrustKind::kNone) ticks.insert(game_.tick());
  seat.dropped_below = seat.next_seq;
  seat.next_seq = game_.end_thrusts(seat.louse, seat.next_seq, std::move(ticks));
}

std::span<const InputMargin> InputDesk::margins(std::uint64_t tick, Time begun) {
  acks_.take(tick, due_);
  margins_.clear();
  for (const PendingAck& ack : due_) {
    const auto late = static_cast<std::int64_t>(ack.ticks_late * 1'000'000 / game_.settings().tick_hz);
    const std::int64_t margin = duration_cast<microseconds>(begun - ack.arrived).count() - late;
    margins_.push_back({ack.player, ack.filed, margin});
  }
  return margins_;
}

void InputDesk::answer(std::uint64_t tick, Time begun) {
  assert(tick + 1 == game_.tick());
  for (const PendingAck& pending : due_) {
    const Seat* seat = seats_.find(pending.session);
    if (!seat) continue;
    protocol::Ack ack;
    ack.seq = pending.seq;
    ack.tick = tick;
    ack.margin_us = duration_cast<microseconds>(begun - pending.arrived).count();
    ack.late = pending.late;
    ack.dropped = pending.filed < seat->dropped_below;
    ack.clamped = pending.clamped;
    const state::Louse* louse = ack.dropped ? nullptr : game_.world().find(pending.player);
    if (louse != nullptr) ack.you = protocol::ExactState{game_.tick(), *louse};
    std::get<SessionOccupant>(seat->occupant).subscriber->answer(ack);
  }
  due_.clear();
}

}  // namespace woodlouse::server
