// Players that look at nothing: keys pressed by the clock. Who plays by looking must beat them.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "client/controls/steering.h"
#include "shared/match/match.h"

namespace woodlouse::bench {

enum class BlindKind : std::uint8_t {
  kSpace,      ///< Space: full thrust, whither one was spawned
  kSpaceAndA,  ///< the same, and A once a second: a 16th of the circle to the left
};

constexpr std::string_view to_text(BlindKind kind) {
  return kind == BlindKind::kSpace ? "Space" : "Space and A";
}

/// Presses them at a client's steering.
class BlindPlayer {
 public:
  BlindPlayer(BlindKind kind, match::PlayerId louse, std::uint32_t tick_hz)
      : kind_(kind), louse_(louse), tick_hz_(tick_hz), steering_(tick_hz) {}

  [[nodiscard]] match::PlayerId louse() const { return louse_; }
  [[nodiscard]] BlindKind kind() const { return kind_; }
  /// Before each tick.
  void steer(match::Match& game);

 private:
  BlindKind kind_;
  match::PlayerId louse_;
  std::uint32_t tick_hz_;
  client::Steering steering_;
  std::optional<std::uint64_t> began_;  ///< tick
  std::uint32_t seq_ = 0;
};

}  // namespace woodlouse::bench
