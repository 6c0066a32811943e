// Counts what a program allocates: at every operator new, and at every std::aligned_alloc of what is linked
// into it (Asio's own). Compiled apart, and linked with --wrap=aligned_alloc.
#pragma once

#include <cstddef>

namespace woodlouse::server::test {

/// From now on, from 0. One thread.
void count_allocations();
/// How many there were since; ends the count.
std::size_t allocations_counted();

}  // namespace woodlouse::server::test
