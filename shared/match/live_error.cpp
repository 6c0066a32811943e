#include "shared/match/live_error.h"

#include <cassert>
#include <span>

namespace woodlouse::match {

LiveError::LiveError(const map::Map& map, double tick, state::Mode mode, std::uint64_t settling)
    : tick_seconds_(tick), settling_(settling), error_(map, tick, mode), twin_(map, tick, mode) {
  assert(tick > 0.0 && settling < kMostWaiting);
}

void LiveError::find(const state::Louse& louse, std::uint64_t tick) {
  assert(counted_ == 0 || louse.id == counted_);
  if (tick < next_) return;
  while (!waiting_.empty() && waiting_.back().tick >= tick) waiting_.pop_back();
  waiting_.push_back({tick, louse});
  if (waiting_.size() > kMostWaiting) waiting_.pop_front();
  assert(waiting_.back().tick == tick);
}

void LiveError::count(std::size_t most) {
  for (; most > 0 && !waiting_.empty(); --most) {
    const Found& found = waiting_.front();
    if (waiting_.back().tick - found.tick < settling_) return;
    assert(found.tick >= next_);
    error_.observe(std::span(&found.louse, 1), found.tick);
    twin_.observe(std::span(&found.louse, 1), error_.stepped());
    next_ = found.tick + 1;
    counted_ = found.louse.id;
    waiting_.pop_front();
  }
}

std::optional<ErrorReading> LiveError::reading() const {
  if (error_.figures().empty()) return std::nullopt;
  const ErrorFigure& figure = error_.figures().begin()->second;
  const std::optional<Twin::Apart> now = twin_.apart(counted_);
  assert(figure.ticks > 0 && now);
  ErrorReading reading;
  reading.seconds = static_cast<double>(figure.ticks) * tick_seconds_;
  reading.of_play = error_.of_play(figure);
  reading.worst = figure.worst;
  reading.worst_tick = figure.worst_tick;
  const auto windows = twin_.divergences().find(counted_);
  const bool is_whole = windows != twin_.divergences().end();
  reading.apart = is_whole ? windows->second.back() : now->metres;
  reading.apart_seconds = is_whole ? Twin::kSeconds : static_cast<double>(now->ticks) * tick_seconds_;
  return reading;
}

}  // namespace woodlouse::match
