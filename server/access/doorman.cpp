#include "server/access/doorman.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "server/timing/budgets.h"
#include "shared/core/joined.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {

protocol::ErrorMessage banned_error(const Ban& ban) {
  return {std::string(protocol::code::kBanned),
          core::joined({"the operator has banned ", ban.range ? "your address" : "this name", " ",
                        until_text(ban.until)}),
          true,
          {}};
}

Doorman::Refusal Doorman::why_not_connect(const boost::asio::ip::address& address, WallTime now) const {
  const std::lock_guard lock(mutex_);
  const Ban* ban = bans_.of(address, now);
  return ban == nullptr ? std::nullopt : Refusal(banned_error(*ban));
}

Doorman::Refusal Doorman::why_no_token(const protocol::Join& join, const Comer& comer) {
  if (!passwords_) return std::nullopt;
  const auto error = [](std::string_view code, std::string text) {
    return protocol::ErrorMessage{std::string(code), std::move(text), false, {}};
  };
  if (!comer.is_confidential && plain_ == Plain::kRefused)
    return error(protocol::code::kBadToken,
                 "join.token: on the way here others may read it: come over TLS, or from the machine itself");
  if (const Duration wait = wrong_.wait(comer.address, comer.now); wait > Duration{}) {
    protocol::ErrorMessage limited =
        error(protocol::code::kRateLimited, "join.token: too many wrong ones came from your address");
    limited.retry_after_ms = retry_after_ms(wait);
    return limited;
  }
  if (passwords_->right_of(join.token)) return std::nullopt;
  if (join.token.empty())
    return error(protocol::code::kBadToken,
                 "join.token is missing: who plays here has a password (woodlouse --password-file FILE)");
  wrong_.count(comer.address, comer.now);
  return error(protocol::code::kBadToken, "join.token is no password of this server");
}

Right Doorman::right_of(std::string_view token) const {
  const std::lock_guard lock(mutex_);
  return passwords_ ? passwords_->right_of(token).value_or(Right::kPlayer) : Right::kPlayer;
}

void Doorman::use(Passwords passwords, Plain plain) {
  const std::lock_guard lock(mutex_);
  passwords_ = std::move(passwords);
  plain_ = plain;
}

Doorman::Refusal Doorman::why_not_join(const protocol::Join& join, WallTime now, const Comer& comer) {
  const std::lock_guard lock(mutex_);
  if (auto refusal = why_no_token(join, comer)) return refusal;
  if (const Ban* ban = bans_.of(std::string_view(join.name), now)) return banned_error(*ban);
  return std::nullopt;
}

Doorman::Refusal Doorman::why_no_newcomer(WallTime now) const {
  const std::lock_guard lock(mutex_);
  if (!drains_until_) return std::nullopt;
  const auto left = std::max(WallTime::duration{}, *drains_until_ - now).count();
  return protocol::ErrorMessage{
      std::string(protocol::code::kDraining),
      core::joined({"join: the server stops in ", std::to_string(left), " s and takes nobody any more"}),
      false,
      {}};
}

Doorman::Refusal Doorman::why_not_speak(std::string_view address, WallTime now) const {
  const std::lock_guard lock(mutex_);
  if (mutes_.empty()) return std::nullopt;
  const auto range = AddressRange::parse(address);
  for (const Mute& mute : mutes_) {
    if (mute.until <= now || !range || !mute.range.contains(*range)) continue;
    return protocol::ErrorMessage{std::string(protocol::code::kMuted),
                                  "chat: your address has been muted " + until_text(mute.until),
                                  false,
                                  {}};
  }
  return std::nullopt;
}

bool Doorman::is_draining() const {
  const std::lock_guard lock(mutex_);
  return drains_until_.has_value();
}

void Doorman::use(Bans bans) {
  const std::lock_guard lock(mutex_);
  std::swap(bans_, bans);
}

Bans Doorman::bans() const {
  const std::lock_guard lock(mutex_);
  return bans_;
}

void Doorman::mute(const Mute& mute, WallTime now) {
  assert(mute.until > now);
  const std::lock_guard lock(mutex_);
  std::erase_if(mutes_, [&](const Mute& there) { return there.range == mute.range || there.until <= now; });
  if (mutes_.size() >= kMostMutes) mutes_.erase(mutes_.begin());
  mutes_.push_back(mute);
}

std::size_t Doorman::unmute(const AddressRange& range) {
  const std::lock_guard lock(mutex_);
  return std::erase_if(mutes_, [&range](const Mute& mute) { return range.contains(mute.range); });
}

void Doorman::drain(WallTime until) {
  const std::lock_guard lock(mutex_);
  drains_until_ = until;
}

}  // namespace woodlouse::server
