#include "server/net/allowance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string_view>
#include <utility>
#include <variant>

#include "shared/protocol/codes.h"

namespace woodlouse::server {
namespace {

namespace code = protocol::code;

constexpr double kPausesPerSecond = 60.0;

/// Lines that are looked at one behind the other: eight, or as many as are allowed in the time of a pause.
double at_once(const protocol::Limits& limits) {
  return std::max(8.0, std::ceil(limits.messages_per_s / kPausesPerSecond));
}

protocol::ErrorMessage limited(std::string text, Duration wait) {
  return {std::string(code::kRateLimited), std::move(text), false, retry_after_ms(wait)};
}

}  // namespace

std::optional<Spending> spending_of(const protocol::ClientMessage& message) {
  if (std::holds_alternative<protocol::Join>(message)) return Spending::kJoin;
  if (std::holds_alternative<protocol::Chat>(message)) return Spending::kChat;
  if (std::holds_alternative<protocol::Moderate>(message)) return Spending::kChat;
  if (std::holds_alternative<protocol::Respawn>(message)) return Spending::kRespawn;
  if (std::holds_alternative<protocol::List>(message)) return Spending::kAnswerBytes;
  return std::nullopt;
}

bool waits_for_its_turn(const protocol::ClientMessage& message) {
  return std::holds_alternative<protocol::GetMap>(message) ||
         std::holds_alternative<protocol::Resync>(message) ||
         std::holds_alternative<protocol::ListRecords>(message) ||
         std::holds_alternative<protocol::GetGhost>(message);
}

std::size_t AnswerSizes::of(const protocol::ClientMessage& question) const {
  assert(waits_for_its_turn(question));
  if (std::holds_alternative<protocol::GetMap>(question)) return map;
  if (std::holds_alternative<protocol::GetGhost>(question)) return ghost;
  return std::holds_alternative<protocol::Resync>(question) ? key : records;
}

Allowance::Allowance(const protocol::Limits& limits, std::shared_ptr<AddressAccount> address, Time now)
    : messages_per_s_(limits.messages_per_s),
      lines_(limits.messages_per_s, limits.burst, now),
      pace_(kPausesPerSecond * at_once(limits), at_once(limits), now),
      own_(session_rates(limits), now),
      address_(std::move(address)) {
  assert(address_ != nullptr);
}

Duration Allowance::wait_for_line(Time now) {
  if (const Duration left = wait(Spending::kLineBytes, now); left > Duration{}) return left;
  pace_.charge(0.0, now);
  // Not for each of them: a pause is worth half of what goes at once.
  return pace_.wait(1.0) == Duration{} ? Duration{} : pace_.wait(4.0);
}

Allowance::Refusal Allowance::take_line(std::size_t bytes, Time now) {
  pace_.charge(1.0, now);
  own_.charge(Spending::kLineBytes, static_cast<double>(bytes), now);
  address_->charge(Spending::kLineBytes, static_cast<double>(bytes), now);
  switch (lines_.take(now)) {
    case RateLimiter::Verdict::kPass:
      return std::nullopt;
    case RateLimiter::Verdict::kRefuse:
      return limited(
          "more than " + std::to_string(messages_per_s_) + " messages a second: this one was dropped",
          lines_.wait());
    case RateLimiter::Verdict::kFlood:
      break;
  }
  return protocol::ErrorMessage{
      std::string(code::kFlood), "messages kept coming long after rate_limited", true, {}};
}

Duration Allowance::wait(Spending what, Time now) {
  return std::max(own_.wait(what, now), address_->wait(what, now));
}

Allowance::Refusal Allowance::spend(Spending what, Time now) {
  if (const Duration left = wait(what, now); left > Duration{})
    return limited("you, or all of your address together, do this too often: it was dropped", left);
  if (what == Spending::kAnswerBytes) return std::nullopt;
  own_.charge(what, 1.0, now);
  address_->charge(what, 1.0, now);
  return std::nullopt;
}

void Allowance::charge_answer(std::size_t bytes, Time now) {
  own_.charge(Spending::kAnswerBytes, static_cast<double>(bytes), now);
  address_->charge(Spending::kAnswerBytes, static_cast<double>(bytes), now);
}

Allowance::Refusal Allowance::ask(protocol::ClientMessage question) {
  const bool waits = std::any_of(waiting_.begin(), waiting_.end(), [&question](const auto& other) {
    return other.index() == question.index();
  });
  if (waits)
    return limited("you have asked for it already: answers of too many bytes come late",
                   std::chrono::seconds(1));
  waiting_.push_back(std::move(question));
  return std::nullopt;
}

std::optional<protocol::ClientMessage> Allowance::due(Time now) {
  if (waiting_.empty() || wait(Spending::kAnswerBytes, now) > Duration{}) return std::nullopt;
  protocol::ClientMessage first = std::move(waiting_.front());
  waiting_.erase(waiting_.begin());
  return first;
}

std::optional<Time> Allowance::next(Time now) {
  if (waiting_.empty()) return std::nullopt;
  return now + wait(Spending::kAnswerBytes, now);
}

std::vector<protocol::ErrorMessage> Allowance::refuse_waiting() {
  return {std::exchange(waiting_, {}).size(),
          {std::string(code::kRateLimited),
           "too many bytes of answers have gone to you or your address: what you asked for is left out",
           false,
           {}}};
}

}  // namespace woodlouse::server
