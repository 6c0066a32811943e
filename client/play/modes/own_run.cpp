#include "client/play/modes/own_run.h"

#include <algorithm>
#include <string>
#include <utility>

#include "client/drawing/formatted.h"
#include "client/play/modes/goal.h"

namespace woodlouse::client {
namespace {

constexpr double kMomentsOfATick = 65536.0;

}  // namespace

void OwnRun::show(std::string text, Tone tone, core::Time now) {
  splash_ = {std::move(text), tone};
  splashed_ = now;
}

void OwnRun::event(const protocol::Event& event, std::uint32_t you, std::uint32_t tick_hz, core::Time now) {
  using protocol::EventKind;
  if (you == 0 || event.id != you) return;
  const auto value = [&event](std::size_t k) { return event.values[k].value_or(0); };
  switch (event.kind) {
    case EventKind::kGate:
      if (event.values[3])  // against the best lap: the sign says it, the colour only repeats it
        show(formatted("%+.2f", static_cast<double>(value(3)) / kMomentsOfATick / tick_hz),
             value(3) <= 0 ? Tone::kGood : Tone::kBad, now);
      else if (value(2) > 0)
        show(span_text(value(2), tick_hz), Tone::kUsual, now);
      break;
    case EventKind::kLapDone:
      show(span_text(value(1), tick_hz), value(2) != 0 ? Tone::kGood : Tone::kUsual, now);
      break;
    case EventKind::kRun:
      show(span_text(value(0), tick_hz), Tone::kGoal, now);
      break;
    case EventKind::kCrumb:
      chain_ = value(2);
      chain_at_ = event.moment;
      if (value(1) > 1 || chain_ > 1)
        show(formatted(chain_ > 1 ? "+%ldx%ld" : "+%ld", static_cast<long>(value(1)),
                       static_cast<long>(chain_)),
             Tone::kGoal, now);
      break;
    default:
      break;
  }
}

void OwnRun::own_lap(double seconds, bool is_best, core::Time now) {
  show(formatted("%.2f", seconds), is_best ? Tone::kGood : Tone::kUsual, now);
}

void OwnRun::observe(const Standing& standing) {
  if (standing.lap_start == 0)
    run_start_ = 0;
  else if (standing.lap == 0)
    run_start_ = standing.lap_start;
}

std::optional<Splash> OwnRun::splash(core::Time now) const {
  if (!splashed_ || now - *splashed_ >= kSplashFor) return std::nullopt;
  return splash_;
}

double OwnRun::chain_left(double tick, std::uint32_t tick_hz) const {
  if (chain_ == 0) return 0.0;
  const double seconds = (tick - static_cast<double>(chain_at_) / kMomentsOfATick) / tick_hz;
  return std::clamp(1.0 - seconds / kChainSeconds, 0.0, 1.0);
}

std::int64_t OwnRun::chain(double tick, std::uint32_t tick_hz) const {
  return chain_left(tick, tick_hz) > 0.0 ? chain_ : 0;
}

}  // namespace woodlouse::client
