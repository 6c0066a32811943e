# The flags every target of ours is built with, on one INTERFACE target.
#
# -ffp-contract=off: the simulation promises the same bits from every compiler and machine; a fused
#   multiply-add rounds once where the source rounds twice. Never remove it, never add -ffast-math.
# -fno-math-errno: sqrt is the one machine instruction (IEEE exact), not a call that may set errno.
# -fno-trapping-math: lets the vectoriser work on select expressions; rounding is not touched.
# Asserts stay on in Release (no -DNDEBUG): they stand outside the inner loops and cost nothing there.
add_library(woodlouse_flags INTERFACE)
target_include_directories(woodlouse_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_features(woodlouse_flags INTERFACE cxx_std_20)
target_compile_options(woodlouse_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror
  -ffp-contract=off -fno-math-errno -fno-trapping-math
  # GCC 12 warns of overlaps in std::string's operator+ that can't be (GCC PR 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)

set(CMAKE_CXX_FLAGS_RELEASE "-O3")
set(CMAKE_CXX_FLAGS_DEBUG "-O0 -g")

set(WOODLOUSE_SANITIZE "" CACHE STRING "Sanitizers, as in -fsanitize= (for example address,undefined)")
if(WOODLOUSE_SANITIZE)
  target_compile_options(woodlouse_flags INTERFACE -fsanitize=${WOODLOUSE_SANITIZE} -fno-omit-frame-pointer
                         -fno-sanitize-recover=all)
  target_link_options(woodlouse_flags INTERFACE -fsanitize=${WOODLOUSE_SANITIZE})
endif()

# So that cmake/proof can show that a flag which breaks the promise is caught; a list, after all others.
set(WOODLOUSE_LAST_FLAGS "" CACHE STRING "Compiler options after all others; only to break the build on purpose")
target_compile_options(woodlouse_flags INTERFACE ${WOODLOUSE_LAST_FLAGS})
