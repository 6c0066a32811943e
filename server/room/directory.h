// Which rooms there are, as a session sees them; the lobby is one.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/room/door.h"
#include "server/timing/clock.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// Any thread.
class Directory {
 public:
  Directory() = default;
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
  virtual ~Directory() = default;

  /// The door of that name, the first one for an empty name, or null.
  [[nodiscard]] virtual std::shared_ptr<Door> find(std::string_view name) const = 0;
  /// That, if who has this role may come in there; or null.
  [[nodiscard]] std::shared_ptr<Door> find_for(protocol::Role role, std::string_view name) const {
    auto door = find(name);
    return door && door->only_shows() && role != protocol::Role::kSpectator ? nullptr : door;
  }
  [[nodiscard]] virtual std::vector<std::string> names() const = 0;
  [[nodiscard]] virtual protocol::Rooms list() const = 0;
  /// Another number once a room has opened or closed, or is at another server.
  [[nodiscard]] virtual std::uint64_t changes() const = 0;
  /// Why nobody should be sent here now; empty: he may be.
  [[nodiscard]] virtual std::string_view why_not_ready(Time now) const = 0;
};

/// Of one who wants to hear when a room opens or closes: looks from time to time, so that nobody who has gone
/// is on any list, and many rooms that open together are told once. One thread.
class DirectoryWatch {
 public:
  static constexpr Duration kEvery = std::chrono::seconds(1);

  /// From now on, or no more.
  void set(bool is_on, const Directory& directory, Time now) {
    changes_ = is_on ? std::optional(directory.changes()) : std::nullopt;
    next_ = now + kEvery;
  }
  [[nodiscard]] bool is_on() const { return changes_.has_value(); }
  /// When to look again.
  [[nodiscard]] Time next() const { return changes_ ? next_ : Time::max(); }
  /// Whether it has changed since he was told; from then on he has been.
  [[nodiscard]] bool take_change(const Directory& directory, Time now) {
    if (now < next()) return false;
    next_ = now + kEvery;
    const std::uint64_t changes = directory.changes();
    return std::exchange(changes_, changes) != changes;
  }

 private:
  std::optional<std::uint64_t> changes_;  ///< as he was told; none: he does not ask
  Time next_{};
};

}  // namespace woodlouse::server
