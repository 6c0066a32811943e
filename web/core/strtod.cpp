// The C library's strtod computes in long doubles, which WebAssembly has in software alone: 3 KB, packed,
// that nobody asks for but nlohmann's parser. The linker puts this in its place (--wrap).
#include <fast_float/fast_float.h>

#include <cstring>

/// Of a number as JSON writes it; an infinity where it is too large.
extern "C" double __wrap_strtod(const char* text, char** end) {
  double value = 0.0;
  const auto read = fast_float::from_chars(text, text + std::strlen(text), value);
  if (end != nullptr) *end = const_cast<char*>(read.ptr);
  return value;
}
