# The page in the server: core.wasm is built by clang for WebAssembly (the preset wasm), packed with web/page into a C++
# file, and compiled into a library. Who lacks the compiler has a server without a page.
option(WOODLOUSE_PAGE "Build core.wasm and put the page into the server" ON)

# What is missing to build core.wasm; empty: nothing.
function(woodlouse_missing_for_page result)
  set(missing)
  foreach(program clang++-19 wasm-ld-19 llvm-ar-19 esbuild)
    find_program(WOODLOUSE_${program} ${program})
    if(NOT WOODLOUSE_${program})
      list(APPEND missing ${program})
    endif()
  endforeach()
  foreach(header wasm32-wasi/stdlib.h wasm32-wasi/c++/v1/vector fast_float/fast_float.h fmt/format.h)
    if(NOT EXISTS /usr/include/${header})
      list(APPEND missing ${header})
    endif()
  endforeach()
  set(${result} "${missing}" PARENT_SCOPE)
endfunction()

# woodlouse_embed_page(TARGET): embedded_page() of server/web/page_files.h.
function(woodlouse_embed_page target)
  set(page ${PROJECT_SOURCE_DIR}/web/page)
  woodlouse_missing_for_page(missing)
  if(WOODLOUSE_PAGE AND missing)
    message(STATUS "No page at --web: there is no ${missing} (packages.txt names the packages)")
  endif()
  if(NOT WOODLOUSE_PAGE OR missing OR NOT EXISTS ${page}/index.html)
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/server/web/no_page.cpp)
    return()
  endif()

  # The inner build finds out what is to be done; what it may depend on is named here, and looked for anew before each
  # build: files come and go.
  set(core_build ${PROJECT_BINARY_DIR}/wasm)
  set(core ${core_build}/bin/core.wasm)
  file(GLOB_RECURSE core_sources CONFIGURE_DEPENDS LIST_DIRECTORIES true ${PROJECT_SOURCE_DIR}/shared/* ${PROJECT_SOURCE_DIR}/web/core/* ${PROJECT_SOURCE_DIR}/web/third_party/*)
  add_custom_command(OUTPUT ${core}
    COMMAND ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR} -B ${core_build} -G Ninja -DCMAKE_BUILD_TYPE=Release -DWOODLOUSE_ONLY=web
            -DCMAKE_TOOLCHAIN_FILE=${PROJECT_SOURCE_DIR}/cmake/wasm.cmake > ${core_build}.log
    COMMAND ${CMAKE_COMMAND} --build ${core_build} --parallel 2 --target core > ${core_build}.log
    COMMAND ${CMAKE_COMMAND} -E touch ${core}
    DEPENDS ${core_sources} ${PROJECT_SOURCE_DIR}/CMakeLists.txt ${PROJECT_SOURCE_DIR}/web/CMakeLists.txt ${PROJECT_SOURCE_DIR}/cmake/wasm.cmake
            ${PROJECT_SOURCE_DIR}/cmake/order_functions.sh ${PROJECT_SOURCE_DIR}/cmake/Flags.cmake ${PROJECT_SOURCE_DIR}/cmake/Dependencies.cmake
    COMMENT "Compiling the core for browsers (core.wasm)" VERBATIM)
  file(GLOB_RECURSE page_sources CONFIGURE_DEPENDS LIST_DIRECTORIES true ${page}/*)
  set(packed ${PROJECT_BINARY_DIR}/page)
  add_custom_command(OUTPUT ${packed}/embedded_page.cpp
    COMMAND ${PROJECT_SOURCE_DIR}/cmake/pack_page.sh ${packed} ${page} ${core}
    DEPENDS ${page} ${page_sources} ${core} ${PROJECT_SOURCE_DIR}/cmake/pack_page.sh
    COMMENT "Packing the page" VERBATIM)
  add_custom_target(woodlouse_page DEPENDS ${packed}/embedded_page.cpp)
  target_sources(${target} PRIVATE ${packed}/embedded_page.cpp)
  # Its bytes are no part of what a compiler's cache sees.
  set_source_files_properties(${packed}/embedded_page.cpp PROPERTIES SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
