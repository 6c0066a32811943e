#include "server/limit_options.h"

#include <algorithm>

#include "server/config.h"
#include "server/signals.h"
#include "shared/state/mode.h"

namespace woodlouse::server {

protocol::Limits limits_of(const ServeConfig& config) {
  constexpr std::uint64_t kOwnFiles = 64;
  constexpr std::uint64_t kAdminFiles =
      128;  // connections to its door, and recordings of rooms that it opens
  protocol::Limits limits = completed(config.limits, config.tick_hz);
  const std::size_t rooms = config.maps.size() * (config.mode ? 1 : state::kModes.size());
  const std::uint64_t own = kOwnFiles + 2 * rooms + (config.admin ? kAdminFiles : 0);
  const std::uint64_t files = std::max(own + 1, raise_descriptor_limit());
  limits.max_connections =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(limits.max_connections, files - own));
  return limits;
}

}  // namespace woodlouse::server
