# Every outside library, found once. The Debian packages that hold them stand in packages.txt.
find_package(nlohmann_json 3.11 REQUIRED)
find_package(tl-expected REQUIRED)
find_path(XXHASH_INCLUDE_DIR xxhash.h REQUIRED)
# A browser has one thread, and zstd's decoder comes along (web/third_party); libc++ reads no decimal doubles before its
# version 20, but by what it reads them with since.
if(WOODLOUSE_ONLY STREQUAL "web")
  find_package(FastFloat REQUIRED)
  add_library(Threads::Threads INTERFACE IMPORTED)
  return()
endif()
find_package(Threads REQUIRED)
find_package(CLI11 REQUIRED)
# So far headers alone, which serve any machine.
if(WOODLOUSE_ONLY STREQUAL "scenario")
  return()
endif()
find_path(ZSTD_INCLUDE_DIR zstd.h REQUIRED)
find_library(ZSTD_LIBRARY zstd REQUIRED)
add_library(woodlouse_zstd INTERFACE)
target_include_directories(woodlouse_zstd SYSTEM INTERFACE $<BUILD_INTERFACE:${ZSTD_INCLUDE_DIR}>)
target_link_libraries(woodlouse_zstd INTERFACE $<BUILD_INTERFACE:${ZSTD_LIBRARY}> $<INSTALL_INTERFACE:zstd>)
if(WOODLOUSE_ONLY STREQUAL "freestanding")
  return()
endif()
find_package(Boost 1.81 REQUIRED)
find_package(spdlog REQUIRED)
find_package(OpenSSL 3.0 REQUIRED)
# Of prometheus-cpp the core alone; its package would have its web server's and its gateway's libraries, too.
find_path(PROMETHEUS_INCLUDE_DIR prometheus/text_serializer.h REQUIRED)
find_library(PROMETHEUS_LIBRARY prometheus-cpp-core REQUIRED)
add_library(woodlouse_prometheus INTERFACE)
target_include_directories(woodlouse_prometheus SYSTEM INTERFACE ${PROMETHEUS_INCLUDE_DIR})
target_link_libraries(woodlouse_prometheus INTERFACE ${PROMETHEUS_LIBRARY})
# What keeps rooms beyond one machine: where Debian's libnats is, but not for who only plays; -DWOODLOUSE_CLUSTER=ON or OFF says otherwise.
find_path(NATS_INCLUDE_DIR nats/nats.h)
find_library(NATS_LIBRARY nats)
if(NOT DEFINED WOODLOUSE_CLUSTER)
  set(WOODLOUSE_CLUSTER OFF)
  if(NATS_INCLUDE_DIR AND NATS_LIBRARY AND NOT WOODLOUSE_ONLY STREQUAL "play")
    set(WOODLOUSE_CLUSTER ON)
  endif()
endif()
if(WOODLOUSE_CLUSTER)
  if(NOT NATS_INCLUDE_DIR OR NOT NATS_LIBRARY)
    message(FATAL_ERROR "WOODLOUSE_CLUSTER needs libnats:  apt-get install libnats-dev")
  endif()
  add_library(woodlouse_nats INTERFACE)
  target_include_directories(woodlouse_nats SYSTEM INTERFACE $<BUILD_INTERFACE:${NATS_INCLUDE_DIR}>)
  target_link_libraries(woodlouse_nats INTERFACE $<BUILD_INTERFACE:${NATS_LIBRARY}> $<INSTALL_INTERFACE:nats>)
endif()
# What tests and measures need, players don't.
if(NOT WOODLOUSE_ONLY STREQUAL "play")
  find_package(Eigen3 3.4 REQUIRED NO_MODULE)
  find_package(benchmark REQUIRED)
endif()

# Asio with C++20 coroutines. The separate target keeps Boost out of shared/.
add_library(woodlouse_asio STATIC ${CMAKE_CURRENT_LIST_DIR}/asio.cpp)
target_link_libraries(woodlouse_asio PUBLIC woodlouse_flags Boost::headers Threads::Threads)
target_compile_definitions(woodlouse_asio PUBLIC
  BOOST_ASIO_SEPARATE_COMPILATION BOOST_ASIO_NO_DEPRECATED BOOST_ASIO_DISABLE_BOOST_COROUTINE
  # Blocks of memory that a thread keeps for handlers to come, of each kind: those of a broadcast's slice, and a few more.
  BOOST_ASIO_RECYCLING_ALLOCATOR_CACHE_SIZE=80)
if(WOODLOUSE_SANITIZE MATCHES "thread")
  # The thread sanitizer does not see stand-alone fences. Asio does without most of them; the one left guards
  # reference counts, whose own atomics the sanitizer sees.
  target_compile_definitions(woodlouse_asio PUBLIC BOOST_ASIO_DISABLE_FENCED_BLOCK)
  target_compile_options(woodlouse_asio PUBLIC $<$<CXX_COMPILER_ID:GNU>:-Wno-tsan>)
endif()
