#include "server/timing/code_counts.h"

#include <algorithm>
#include <cassert>

#include "shared/protocol/codes.h"

namespace woodlouse::server {

void CodeCounts::add(std::string_view code) {
  const auto codes = protocol::codes();
  const auto found =
      std::find_if(codes.begin(), codes.end(), [code](const auto& entry) { return entry.code == code; });
  assert(found != codes.end() && codes.size() <= kMost);
  counts_[static_cast<std::size_t>(found - codes.begin())].fetch_add(1, std::memory_order_relaxed);
}

}  // namespace woodlouse::server
