// What a library that allocates by itself, and could not, leads to.
#pragma once

#include <cstdlib>
#include <new>

namespace woodlouse::core {

/// As operator new does; where there are no exceptions, the end.
[[noreturn]] inline void out_of_memory() {
#ifdef __cpp_exceptions
  throw std::bad_alloc();
#else
  std::abort();
#endif
}

}  // namespace woodlouse::core
