// What becomes of a program that gets no memory.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

namespace woodlouse::core {

/// What a library that allocates by itself, and could not, leads to: as operator new does; where there are no
/// exceptions, the end.
[[noreturn]] inline void out_of_memory() {
#ifdef __cpp_exceptions
  throw std::bad_alloc();
#else
  std::abort();
#endif
}

/// From now on, in any thread, a request for memory that is not met ends the program with this line on
/// standard error and exit code 1; so does a std::bad_alloc that nobody catches, of who asks by other ways
/// than operator new. REQUIRES a text that outlives the program. Not for who has a terminal to put right
/// first.
inline void end_when_out_of_memory(const char* line) {
  static const char* text;
  text = line;
  static constexpr auto kEnd = [] {
    std::fputs(text, stderr);
    std::_Exit(1);
  };
  std::set_new_handler(kEnd);
#ifdef __cpp_exceptions
  static const std::terminate_handler others = std::get_terminate();
  std::set_terminate([] {
    try {
      if (const auto error = std::current_exception()) std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
      kEnd();
    } catch (...) {  // the other handler tells of it
      others();
    }
    others();
  });
#endif
}

}  // namespace woodlouse::core
