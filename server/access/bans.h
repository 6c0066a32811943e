// Who is kept out, by address or by name, and until when. Pure: time is an argument.
#pragma once

#include <boost/asio/ip/address.hpp>

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/access/address_range.h"
#include "shared/core/error.h"

namespace woodlouse::server {

/// What clocks on walls say, UTC: bans outlast the server.
using WallTime = std::chrono::sys_seconds;

[[nodiscard]] inline WallTime wall_now() {
  return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
}

/// 2026-11-27 20:15:00 UTC
[[nodiscard]] std::string utc_text(WallTime time);
/// The same behind `until `, or `for good`.
[[nodiscard]] std::string until_text(const std::optional<WallTime>& until);

struct Ban {
  std::optional<AddressRange> range;  ///< none: it is of the name
  std::string name;                   ///< cleaned
  WallTime since{};
  std::optional<WallTime> until;  ///< none: for good

  [[nodiscard]] std::string who() const { return range ? range->text() : name; }
  [[nodiscard]] bool is_over(WallTime now) const { return until && *until <= now; }
};

/// Names are compared without regard to the case of ASCII letters.
[[nodiscard]] bool is_same_name(std::string_view a, std::string_view b);

/// That name, or the one that a second one of it was given: ann, ann#2.
[[nodiscard]] bool goes_by(std::string_view name, std::string_view banned);

class Bans {
 public:
  static constexpr std::size_t kMost = 4096;

  /// Of that address or name, as text: a text that is no address is a name. Errors: an address with a length
  /// that is none, or too short.
  static core::Expected<Ban> parse(std::string_view who, WallTime now, std::optional<WallTime> until);

  /// In place of one that is there of the same address or name. Errors: there are kMost.
  core::Expected<void> add(Ban ban);
  /// False: there is none.
  [[nodiscard]] bool remove(const Ban& ban);
  void drop_over(WallTime now);

  /// Why that address, or that name, may not come in; null: it may. The one that lasts longest.
  [[nodiscard]] const Ban* of(const boost::asio::ip::address& address, WallTime now) const;
  /// All of them.
  [[nodiscard]] const Ban* of(const AddressRange& addresses, WallTime now) const;
  [[nodiscard]] const Ban* of(std::string_view name, WallTime now) const;
  [[nodiscard]] const std::vector<Ban>& all() const { return bans_; }

 private:
  std::vector<Ban> bans_;  ///< as they were added
};

}  // namespace woodlouse::server
