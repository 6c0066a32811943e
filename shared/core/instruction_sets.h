// What the machine can do beyond what every one of its kind can: files compiled for an instruction set run
// only where it is there.
#pragma once

namespace woodlouse::core {

/// For files compiled with -mavx2.
inline bool has_avx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

/// For files compiled with -mavx512f -mavx512dq -mavx512vl.
inline bool has_avx512() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
         __builtin_cpu_supports("avx512vl") != 0;
#else
  return false;
#endif
}

}  // namespace woodlouse::core
