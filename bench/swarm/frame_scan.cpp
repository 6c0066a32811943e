#include "bench/swarm/frame_scan.h"

#include <charconv>

namespace woodlouse::swarm {

std::optional<std::uint64_t> scan_frame_tick(std::string_view line) {
  for (const std::string_view head : {R"({"type":"delta","tick":)", R"({"type":"key","tick":)"}) {
    if (!line.starts_with(head)) continue;
    std::uint64_t tick = 0;
    const char* const begin = line.data() + head.size();
    const char* const end = line.data() + line.size();
    const auto [rest, error] = std::from_chars(begin, end, tick);
    if (error == std::errc{} && rest != end && *rest == ',' && line.ends_with('}')) return tick;
  }
  return std::nullopt;
}

}  // namespace woodlouse::swarm
