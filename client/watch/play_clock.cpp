#include "client/watch/play_clock.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace woodlouse::client {

PlayClock::PlayClock(std::uint64_t first, std::uint64_t last, std::uint32_t tick_hz)
    : first_(first), last_(last), tick_hz_(tick_hz), position_(static_cast<double>(first)) {
  assert(first <= last && tick_hz > 0);
}

void PlayClock::update(core::Time now) {
  const auto passed =
      updated_ ? std::min<core::Time::duration>(now - *updated_, kLongestGap) : core::Time::duration{};
  updated_ = now;
  if (!playing_) return;
  place(position_ + std::chrono::duration<double>(passed).count() * speed() * tick_hz_);
  if (tick() == last_) playing_ = false;
}

void PlayClock::toggle() {
  if (!playing_ && tick() == last_) place(static_cast<double>(first_));
  playing_ = !playing_;
}

void PlayClock::step(int ticks) {
  playing_ = false;
  place(std::floor(position_) + ticks);
}

void PlayClock::skip(double seconds) { place(std::floor(position_) + std::round(seconds * tick_hz_)); }

void PlayClock::jump(double fraction) {
  const auto length = static_cast<double>(last_ - first_);
  place(static_cast<double>(first_) + std::round(fraction * length));
}

void PlayClock::go_to(std::uint64_t tick) { place(static_cast<double>(tick)); }

void PlayClock::faster() { speed_ = std::min(speed_ + 1, kSpeeds.size() - 1); }

void PlayClock::slower() { speed_ -= speed_ > 0 ? 1 : 0; }

void PlayClock::place(double position) {
  position_ = std::clamp(position, static_cast<double>(first_), static_cast<double>(last_));
}

}  // namespace woodlouse::client
