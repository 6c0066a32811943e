# The flags every target of ours is built with: warnings for this tree alone, on one INTERFACE target what whoever
# links us shares.
#
# -ffp-contract=off: the simulation promises the same bits from every compiler and machine; a fused
#   multiply-add rounds once where the source rounds twice. Never remove it, never add -ffast-math.
# -fno-math-errno: sqrt is the one machine instruction (IEEE exact), not a call that may set errno.
# -fno-trapping-math: lets the vectoriser work on select expressions; rounding is not touched.
# Asserts stay on in Release (no -DNDEBUG): they stand outside the inner loops and cost nothing there.
# -ffp-contract=off is for our headers in others' programs too: of an inline function the linker keeps one copy.
# Warnings become errors in the presets alone (CMAKE_COMPILE_WARNING_AS_ERROR).
add_library(woodlouse_flags INTERFACE)
target_include_directories(woodlouse_flags INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/woodlouse>)
target_compile_features(woodlouse_flags INTERFACE cxx_std_20)
target_compile_options(woodlouse_flags INTERFACE
  -ffp-contract=off $<BUILD_INTERFACE:-fno-math-errno> $<BUILD_INTERFACE:-fno-trapping-math>)
add_compile_options(
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow
  # GCC 12 warns of overlaps in std::string's operator+ that can't be (GCC PR 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # Clang's -Wall wants braces around the base of an aggregate, GCC's does not: {z, zx, zy} names no base.
  $<$<CXX_COMPILER_ID:Clang>:-Wno-missing-braces>)

set(CMAKE_CXX_FLAGS_RELEASE "-O3")
set(CMAKE_CXX_FLAGS_DEBUG "-O0 -g")
# So that a shared library may be made of ours. Nobody is to replace a function of ours from outside: may it be inlined.
if(NOT WOODLOUSE_ONLY STREQUAL "web")
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  add_compile_options(-fno-semantic-interposition)
endif()

set(WOODLOUSE_SANITIZE "" CACHE STRING "Sanitizers, as in -fsanitize= (for example address,undefined)")
if(WOODLOUSE_SANITIZE)
  add_compile_options(-fsanitize=${WOODLOUSE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
    $<IF:$<CXX_COMPILER_ID:Clang>,-gline-tables-only,-g1>)  # a finding needs lines, not variables
  add_link_options(-fsanitize=${WOODLOUSE_SANITIZE})
  find_program(WOODLOUSE_LLD NAMES ld.lld ld.lld-19)
  if(WOODLOUSE_LLD AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    add_link_options(--ld-path=${WOODLOUSE_LLD})  # of programs as large as these, in a quarter of the time
  endif()
endif()

# A sanitized step is ten times as slow without any optimisation; the rest, headers for the most part, only takes twice
# as long to compile with it.
set(WOODLOUSE_OPTIMISED "" CACHE STRING "The targets compiled with -O1 where the others are -O0")
add_compile_options("$<$<IN_LIST:$<TARGET_PROPERTY:NAME>,${WOODLOUSE_OPTIMISED}>:-O1>")

# So that cmake/proof can show that a flag which breaks the promise is caught; a list, after all others.
set(WOODLOUSE_LAST_FLAGS "" CACHE STRING "Compiler options after all others; only to break the build on purpose")
target_compile_options(woodlouse_flags INTERFACE $<BUILD_INTERFACE:${WOODLOUSE_LAST_FLAGS}>)

# Whoever has ccache builds a second clone in a fraction of the time.
find_program(WOODLOUSE_CCACHE ccache)
if(WOODLOUSE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
      env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_SLOPPINESS=pch_defines,time_macros ${WOODLOUSE_CCACHE})
  # What ccache asks for to see through precompiled headers.
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess> "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endif()
