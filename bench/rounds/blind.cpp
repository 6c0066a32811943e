#include "bench/rounds/blind.h"

#include <chrono>

namespace woodlouse::bench {

void BlindPlayer::steer(match::Match& game) {
  const state::Louse* louse = game.world().find(louse_);
  if (louse == nullptr) {
    began_.reset();
    return;
  }
  if (!began_) {
    began_ = game.tick();
    steering_.reset();
    steering_.point(louse->heading);
    steering_.toggle_cruise();
  }
  const std::uint64_t since = game.tick() - *began_;
  const core::Time now{std::chrono::nanoseconds(1'000'000'000 * game.tick() / tick_hz_)};
  if (kind_ == BlindKind::kSpaceAndA && since != 0 && since % tick_hz_ == 0)
    steering_.turn(client::Turn::kLeft, now);
  if (const auto order = steering_.poll(now)) game.file({louse_, ++seq_, order->thrust, order->ticks, 0});
}

}  // namespace woodlouse::bench
