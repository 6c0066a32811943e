# Toolchain file: WebAssembly by Debian's clang, its libc++ and WASI's C library (packages.txt). The page answers the few
# calls to WASI that are left (web/page/core/core.js).
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
foreach(language C CXX)
  set(CMAKE_${language}_COMPILER_TARGET wasm32-wasi)
endforeach()
set(CMAKE_C_COMPILER clang-19)
set(CMAKE_CXX_COMPILER clang++-19)
set(CMAKE_AR llvm-ar-19)
set(CMAKE_RANLIB llvm-ranlib-19)
# Libraries that are headers alone serve any machine.
set(CMAKE_INCLUDE_PATH /usr/include)
