// Bytes that the page has put into the core's memory.
#pragma once

#include <cassert>
#include <cstddef>
#include <string_view>

namespace woodlouse::web {

/// REQUIRES that they are all within the memory there is.
inline std::string_view bytes_at(const char* at, std::size_t size) {
  const std::size_t memory = __builtin_wasm_memory_size(0) * std::size_t{65536};
  assert(at != nullptr || size == 0);
  assert(size <= memory && reinterpret_cast<std::size_t>(at) <= memory - size);
  return {at, size};
}

}  // namespace woodlouse::web
