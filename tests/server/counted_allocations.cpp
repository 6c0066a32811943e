#include "tests/server/counted_allocations.h"

#include <cstdlib>
#include <new>
#include <utility>

namespace {

bool is_counting = false;
std::size_t count = 0;

void* counted(void* memory) {
  if (is_counting) ++count;
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

namespace woodlouse::server::test {

void count_allocations() {
  count = 0;
  is_counting = true;
}

std::size_t allocations_counted() {
  is_counting = false;
  return count;
}

}  // namespace woodlouse::server::test

void* operator new(std::size_t size) { return counted(std::malloc(size)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  void* memory = nullptr;
  return counted(posix_memalign(&memory, step, size) == 0 ? memory : nullptr);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  if (is_counting) ++count;
  return std::malloc(size);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

// The linker leads every call of aligned_alloc here.
extern "C" void* __real_aligned_alloc(std::size_t alignment, std::size_t size);
extern "C" void* __wrap_aligned_alloc(std::size_t alignment, std::size_t size) {
  if (is_counting) ++count;
  return __real_aligned_alloc(alignment, size);
}
