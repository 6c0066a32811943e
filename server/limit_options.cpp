#include "server/limit_options.h"

#include <algorithm>

#include "server/config.h"
#include "shared/state/mode.h"

namespace woodlouse::server {
namespace {

/// Of what was typed: those that follow from others and from the tick rate.
protocol::Limits completed(protocol::Limits typed, std::uint32_t tick_hz) {
  // A bot may push once a tick and still ask for the time.
  if (typed.messages_per_s == 0) typed.messages_per_s = std::max(60u, 2 * tick_hz);
  if (typed.burst == 0) typed.burst = 2 * typed.messages_per_s;
  typed.per_room = typed.max_players + typed.max_bots + typed.max_spectators;
  return typed;
}

}  // namespace

protocol::Limits limits_of(const ServeConfig& config, std::uint64_t may_be_open) {
  constexpr std::uint64_t kOwnFiles = 64;
  constexpr std::uint64_t kAdminFiles =
      128;  // connections to its door, and recordings of rooms that it opens
  protocol::Limits limits = completed(config.limits, config.tick_hz);
  const std::size_t rooms = config.maps.size() * (config.mode ? 1 : state::kModes.size());
  const std::uint64_t own = kOwnFiles + 2 * rooms + (config.admin ? kAdminFiles : 0);
  const std::uint64_t files = std::max(own + 1, may_be_open);
  limits.max_connections =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(limits.max_connections, files - own));
  return limits;
}

}  // namespace woodlouse::server
