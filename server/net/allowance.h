// What a session may ask for: lines a second, what costs others, and answers of many bytes, which come late
// where too many have gone. Pure: time is an argument. One owner, no locking; its address's account is
// shared.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/net/address_account.h"
#include "server/net/rate_limiter.h"
#include "server/timing/budgets.h"
#include "server/timing/clock.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// Whose budget a message is paid from; nothing: it costs nobody else.
std::optional<Spending> spending_of(const protocol::ClientMessage& message);
/// Whether a room answers it with many bytes: it goes through Allowance::ask().
bool waits_for_its_turn(const protocol::ClientMessage& message);

/// [bytes] of what a room answers, as it last was or, of records, the longest so far; guesses before.
struct AnswerSizes {
  std::size_t map = 64u << 10, key = 4u << 10, records = 4u << 10, ghost = 16u << 10;

  /// question: one that waits_for_its_turn().
  [[nodiscard]] std::size_t of(const protocol::ClientMessage& question) const;
};

class Allowance {
 public:
  using Refusal = std::optional<protocol::ErrorMessage>;

  Allowance(const protocol::Limits& limits, std::shared_ptr<AddressAccount> address, Time now);

  /// How long until another line may be looked at; zero: now. Of many that come at once the rest waits,
  /// unread: a room's tick is not behind all that its members can say in a burst; nor are frames behind all
  /// the bytes that an address can send.
  [[nodiscard]] Duration wait_for_line(Time now);
  /// A line of so many bytes has come. Nothing: it may be looked at. A fatal refusal ends the session.
  Refusal take_line(std::size_t bytes, Time now);
  /// Of what costs others, by the session's own budget and its address's. Nothing: it is granted and paid,
  /// but for an answer, which is charged when it is made.
  Refusal spend(Spending what, Time now);
  void charge_answer(std::size_t bytes, Time now);

  /// One that waits_for_its_turn(), answered as soon as due() gives it; refused where one of its kind waits.
  Refusal ask(protocol::ClientMessage question);
  /// One whose turn it is; nothing: none waits, or it is too early. Whoever takes it charges for its answer.
  std::optional<protocol::ClientMessage> due(Time now);
  /// When that will be; nothing: none waits.
  [[nodiscard]] std::optional<Time> next(Time now);
  /// The session leaves and waits for none: the errors that say so.
  std::vector<protocol::ErrorMessage> refuse_waiting();

  [[nodiscard]] AddressAccount& address() const { return *address_; }

 private:
  [[nodiscard]] Duration wait(Spending what, Time now);

  std::uint32_t messages_per_s_;
  RateLimiter lines_;
  TokenBucket pace_;
  Budgets own_;
  std::shared_ptr<AddressAccount> address_;
  std::vector<protocol::ClientMessage> waiting_;  ///< at most one of each kind
};

}  // namespace woodlouse::server
