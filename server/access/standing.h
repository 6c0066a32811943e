// How one connection stands with the operator: whether its joins and its chat are passed on, and what its
// token allows besides playing.
#pragma once

#include <string_view>
#include <utility>
#include <variant>

#include "server/access/doorman.h"
#include "server/timing/clock.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// One thread at a time.
class Standing {
 public:
  /// doorman: outlives it; null: everybody may everything but moderate.
  explicit Standing(Doorman* doorman) : doorman_(doorman) {}

  /// Others may read what he says.
  void is_read_by_others() { is_confidential_ = false; }
  /// address: as sessions are counted by. Nothing: the message is passed on.
  [[nodiscard]] Doorman::Refusal why_not(const protocol::ClientMessage& message, std::string_view address,
                                         Time now) const {
    if (doorman_ == nullptr) return std::nullopt;
    if (const auto* join = std::get_if<protocol::Join>(&message))
      return doorman_->why_not_join(*join, wall_now(), {address, is_confidential_, now});
    if (!std::holds_alternative<protocol::Chat>(message)) return std::nullopt;
    return doorman_->why_not_speak(address, wall_now());
  }
  /// What he is told who has no louse to come back to. Nothing: he is let in.
  [[nodiscard]] Doorman::Refusal why_no_newcomer() const {
    return doorman_ == nullptr ? std::nullopt : doorman_->why_no_newcomer(wall_now());
  }
  /// The join without its token, which nobody else needs to know.
  protocol::Join take_token(protocol::Join& join) {
    if (doorman_ != nullptr) right_ = doorman_->right_of(join.token);
    join.token.clear();
    return std::move(join);
  }
  [[nodiscard]] bool may_moderate() const { return right_ != Right::kPlayer; }

 private:
  Doorman* doorman_;
  bool is_confidential_ = true;   ///< nobody on the way reads what is said
  Right right_ = Right::kPlayer;  ///< by the token of its join
};

}  // namespace woodlouse::server
