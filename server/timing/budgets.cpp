#include "server/timing/budgets.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace woodlouse::server {
namespace {

constexpr double kLogLinesOfAnAddress = 3.0;  // a second: about 400 bytes
constexpr std::chrono::hours kLongest{1};

std::size_t index(Spending what) { return static_cast<std::size_t>(what); }

}  // namespace

void TokenBucket::refill(Time now) {
  if (now <= at_) return;
  tokens_ = std::min(burst_, tokens_ + rate_ * std::chrono::duration<double>(now - at_).count());
  at_ = now;
}

bool TokenBucket::take(double cost, Time now) {
  refill(now);
  if (tokens_ < cost) return false;
  tokens_ -= cost;
  return true;
}

void TokenBucket::charge(double cost, Time now) {
  assert(cost >= 0.0);
  refill(now);
  tokens_ -= cost;
}

Duration TokenBucket::wait(double cost) const {
  const double missing = std::max(0.0, cost - tokens_);
  const double most = std::chrono::duration<double>(kLongest).count();
  const double seconds = missing < most * rate_ ? missing / rate_ : missing > 0.0 ? most : 0.0;
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
}

bool TokenBucket::is_full(Time now) {
  refill(now);
  return tokens_ >= burst_;
}

Budgets::Budgets(const Rates& rates, Time now) {
  for (std::size_t k = 0; k < rates.size(); ++k)
    if (rates[k]) buckets_[k].emplace(*rates[k], *rates[k] * protocol::kSavedSeconds, now);
}

Duration Budgets::wait(Spending what, Time now, double kept_s) {
  std::optional<TokenBucket>& bucket = buckets_[index(what)];
  if (!bucket) return {};
  bucket->charge(0.0, now);
  return bucket->wait(1.0 + kept_s * bucket->rate());
}

void Budgets::charge(Spending what, double cost, Time now) {
  if (auto& bucket = buckets_[index(what)]) bucket->charge(cost, now);
}

std::optional<Duration> Budgets::spend(Spending what, Time now, double kept_s) {
  const Duration left = wait(what, now, kept_s);
  if (left > Duration{}) return left;
  charge(what, 1.0, now);
  return std::nullopt;
}

bool Budgets::are_full(Time now) {
  return std::all_of(buckets_.begin(), buckets_.end(),
                     [now](auto& bucket) { return !bucket || bucket->is_full(now); });
}

Budgets::Rates session_rates(const protocol::Limits& limits) {
  return {limits.chat_per_s,         limits.respawn_per_s, std::nullopt,
          limits.answer_bytes_per_s, std::nullopt,         limits.line_bytes_per_s};
}

Budgets::Rates address_rates(const protocol::Limits& limits) {
  return {limits.chat_per_s_address,         limits.respawn_per_s_address, limits.join_per_s_address,
          limits.answer_bytes_per_s_address, kLogLinesOfAnAddress,         limits.line_bytes_per_s_address};
}

Budgets::Rates room_rates(const protocol::Limits& limits) {
  return {limits.chat_per_s_room, limits.respawn_per_s_room,
          limits.join_per_s_room, std::nullopt,
          std::nullopt,           std::nullopt};
}

std::uint32_t retry_after_ms(Duration wait) {
  const auto ms = std::chrono::duration<double, std::milli>(wait).count();
  return static_cast<std::uint32_t>(std::max(1.0, std::ceil(ms)));
}

}  // namespace woodlouse::server
