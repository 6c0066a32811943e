// Work that is counted, not timed, done on all processors at once. What is timed runs alone.
#pragma once

#include <cstddef>
#include <functional>

namespace woodlouse::lab {

/// Calls work(0) to work(count - 1), each once, on as many threads as there are processors, the caller's
/// among them and free of its core meanwhile, in any order. `work` is called by several threads at once:
/// calls may share nothing they write. done() is called after each, by one thread at a time. What work or
/// done throws, the first of it, is thrown here once all that began have ended.
void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work,
                  const std::function<void()>& done);

}  // namespace woodlouse::lab
