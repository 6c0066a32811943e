#include "server/timing/figures.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace woodlouse::server {
namespace {

double milliseconds(Duration d) { return std::chrono::duration<double, std::milli>(d).count(); }

}  // namespace

std::size_t DurationHistogram::bucket(std::uint64_t us) {
  if (us < kSteps) return us;
  // Values in [2^k, 2^(k+1)), k >= 5, share kSteps buckets of equal width.
  const auto octave = static_cast<std::uint32_t>(std::bit_width(us)) - 6;
  if (octave >= kOctaves) return kSteps * (kOctaves + 1) - 1;
  return kSteps * (octave + 1) + static_cast<std::size_t>((us >> octave) - kSteps);
}

std::uint64_t DurationHistogram::upper_limit(std::size_t bucket) {
  if (bucket < kSteps) return bucket;
  const std::size_t octave = bucket / kSteps - 1;
  return ((bucket % kSteps + kSteps + 1) << octave) - 1;
}

void DurationHistogram::add(Duration value) {
  const auto us = std::chrono::duration_cast<std::chrono::microseconds>(value).count();
  ++counts_[bucket(us > 0 ? static_cast<std::uint64_t>(us) : 0)];
  const auto bound = std::lower_bound(kBounds.begin(), kBounds.end(), value);
  ++ranges_[static_cast<std::size_t>(bound - kBounds.begin())];
  ++count_;
  max_ = std::max(max_, value);
  sum_ += std::max(value, Duration{});
}

std::uint64_t DurationHistogram::count_within(std::size_t bound) const {
  assert(bound < kBounds.size());
  std::uint64_t count = 0;
  for (std::size_t k = 0; k <= bound; ++k) count += ranges_[k];
  assert(count <= count_);
  return count;
}

Duration DurationHistogram::quantile(double q) const {
  if (count_ == 0) return {};
  const auto wanted = static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(count_)));
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    seen += counts_[i];
    if (seen >= wanted) return std::min<Duration>(std::chrono::microseconds(upper_limit(i)), max_);
  }
  return max_;
}

void TrafficMetrics::answer(std::uint32_t status) {
  add_one(web_requests);
  if (status < 400) return;
  const auto known = std::find(kRefusingStatuses.begin(), kRefusingStatuses.end(), status);
  assert(known != kRefusingStatuses.end());
  add_one(web_refused[static_cast<std::size_t>(known - kRefusingStatuses.begin())]);
}

std::string summary(const std::string& room, const RoomFigures& m) {
  const std::string ground =
      m.ground ? fmt::format(", tiles built {} ({} ahead), thrown out {}, read failures {}", m.ground->built,
                             m.ground->ahead, m.ground->thrown_out, m.ground->read_failures)
               : std::string();
  const std::string shadow =
      m.shadow ? fmt::format(", {} ticks shadowed{}, {} differences", m.shadow->ticks,
                             m.shadow->ended ? " until it was ended" : "", m.shadow->differences)
               : std::string();
  const std::string sleeps = m.sleeps != 0 ? fmt::format(", stood still {} times", m.sleeps) : std::string();
  return fmt::format(
      "{}: ticks {}, lateness p50 {:.3f} ms p99 {:.3f} ms max {:.3f} ms, work p50 {:.3f} ms p99 {:.3f} ms, "
      "clock moves {}, frames encoded {}{}{}{}",
      room, m.ticks, milliseconds(m.lateness.quantile(0.5)), milliseconds(m.lateness.quantile(0.99)),
      milliseconds(m.lateness.max()), milliseconds(m.work.quantile(0.5)), milliseconds(m.work.quantile(0.99)),
      m.clock_moves, m.frames_encoded, sleeps, ground, shadow);
}

}  // namespace woodlouse::server
