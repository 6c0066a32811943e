// Where a room is to be found, as far as a client was told: the `host:port` of the wire, and which of several
// is tried next. A stranger wrote them, so nothing else is taken: no port left out, no link, no path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace woodlouse::protocol {

inline constexpr std::size_t kMaxAddressBytes = 261;  ///< of a `host:port`
inline constexpr std::size_t kMaxHosts = 16;          ///< that a hello or a ping names

struct HostAddress {
  std::string host;  ///< a name or an address, IPv6 without brackets
  std::uint16_t port = 0;
  [[nodiscard]] std::string text() const;
  friend bool operator==(const HostAddress&, const HostAddress&) = default;
};

/// "farm.example:7777", "10.0.0.6:7777", "[2001:db8::6]:7777". Nothing: it is none of these.
std::optional<HostAddress> parse_host_address(std::string_view text);

/// Where a client joins, and where it tries next. Pure: times come as arguments, and so does chance, 0 to 1.
class Whereabouts {
 public:
  static constexpr int kMostMoves = 2;     ///< running; who is sent on once more has lost the connection
  static constexpr double kSettled = 5.0;  ///< [s] since the welcome: what comes then is no longer running
  static constexpr double kFirstWait = 0.05, kLongestWait = 2.0;  ///< [s]

  explicit Whereabouts(HostAddress asked) : places_{std::move(asked)} {}

  /// The one that is joined or tried.
  [[nodiscard]] const HostAddress& place() const { return places_[at_]; }
  [[nodiscard]] bool has_others() const { return places_.size() > 1; }

  /// It is joined at place(). hosts: as the server there names them, by its hello or a ping since.
  void welcomed(const std::vector<std::string>& hosts);

  enum class Sent : std::uint8_t { kFollows, kTooOften, kNoAddress };
  /// It was sent on to `address`. kFollows: that is place() now, to be tried at once. up_for: seconds since
  /// the welcome; none: there was none.
  Sent moved(std::string_view address, std::optional<double> up_for);
  /// The line was lost, or an attempt has failed (up_for: none). How long to wait [s] before place() is
  /// tried.
  double lost(std::optional<double> up_for, double chance);

 private:
  void settle(std::optional<double> up_for);

  std::vector<HostAddress> places_;  ///< the last one joined, then the hosts that it named
  std::size_t at_ = 0;
  int moves_ = 0;  ///< running
  int waits_ = 0;  ///< running
};

}  // namespace woodlouse::protocol
