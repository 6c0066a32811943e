// Memory that the page writes into before it calls, and reads from.
#include <cassert>
#include <cstddef>
#include <cstdlib>

#include "web/core/answer.h"

namespace woodlouse::web {

/// So many bytes, aligned for doubles, the caller's until release(); null: there are none left.
WOODLOUSE_EXPORT(allocate) void* allocate(std::size_t size) { return std::malloc(size == 0 ? 1 : size); }

WOODLOUSE_EXPORT(release) void release(void* at) {
  assert(at != nullptr);
  std::free(at);
}

}  // namespace woodlouse::web
