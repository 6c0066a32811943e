// Whom the operator lets in, and whom he lets speak: passwords, bans, mutes, and a server that is about to
// stop. Sessions and ports ask it; what it says is the error that they are told.
#pragma once

#include <boost/asio/ip/address.hpp>

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/access/bans.h"
#include "server/access/passwords.h"
#include "server/timing/clock.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// Any thread, every function: a lock is held for a look-up.
class Doorman {
 public:
  using Refusal = std::optional<protocol::ErrorMessage>;

  /// Further mutes take the place of the oldest.
  static constexpr std::size_t kMostMutes = 1024;

  // What is asked of it. Nothing: he may.

  /// A fatal one.
  [[nodiscard]] Refusal why_not_connect(const boost::asio::ip::address& address, WallTime now) const;
  /// Who wants to join, besides what he says.
  struct Comer {
    std::string_view address;     ///< as sessions are counted by
    bool is_confidential = true;  ///< nobody on the way reads what he says
    Time now{};
  };
  /// A ban's is fatal.
  [[nodiscard]] Refusal why_not_join(const protocol::Join& join, WallTime now, const Comer& comer);
  /// What whoever joined with that token may do.
  [[nodiscard]] Right right_of(std::string_view token) const;
  /// The server is about to stop, and takes only who was here.
  [[nodiscard]] Refusal why_no_newcomer(WallTime now) const;
  /// address: as sessions are counted by (AddressRange::parse() takes it).
  [[nodiscard]] Refusal why_not_speak(std::string_view address, WallTime now) const;
  [[nodiscard]] bool is_draining() const;

  // What the operator says:

  enum class Plain : std::uint8_t { kRefused, kAllowed };  ///< tokens where others may read them
  void use(Passwords passwords, Plain plain);
  void use(Bans bans);
  [[nodiscard]] Bans bans() const;

  /// Of addresses; who is known by his louse is muted by his room.
  struct Mute {
    AddressRange range;
    WallTime until;
  };
  /// In place of one of the same addresses.
  void mute(const Mute& mute, WallTime now);
  /// How many there were.
  std::size_t unmute(const AddressRange& range);

  /// Nobody joins any more who was not here; till then the server goes on.
  void drain(WallTime until);

 private:
  [[nodiscard]] Refusal why_no_token(const protocol::Join& join, const Comer& comer);

  mutable std::mutex mutex_;
  std::optional<Passwords> passwords_;  ///< none: everybody may join
  Plain plain_ = Plain::kRefused;
  WrongTokens wrong_;
  Bans bans_;
  std::vector<Mute> mutes_;
  std::optional<WallTime> drains_until_;
};

/// A ban's error.
[[nodiscard]] protocol::ErrorMessage banned_error(const Ban& ban);

}  // namespace woodlouse::server
