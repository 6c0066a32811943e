# The same headers are not parsed again for each file: half of every build went there.
# The outside headers that most files include are precompiled, and the files of a room (but those that step, whose code
# is most of their time) are compiled eight at a time (options all at once, the lab by groups). So a room's files share what they name in their anonymous
# namespaces; SKIP_UNITY_BUILD_INCLUSION takes out a file whose names another has too. A file includes what it uses
# nevertheless: the preset freestanding compiles without.
option(WOODLOUSE_UNITY "Compile a room's files eight at a time; OFF is faster for who changes one" ON)

set(standard_headers
  <algorithm> <array> <atomic> <bit> <charconv> <chrono> <cmath> <cstring> <deque> <filesystem> <functional> <limits>
  <map> <memory> <optional> <span> <string> <string_view> <utility> <variant> <vector> <tl/expected.hpp>)
set(asio_headers
  <boost/asio/io_context.hpp> <boost/asio/ip/tcp.hpp> <boost/asio/post.hpp> <boost/asio/steady_timer.hpp>
  <boost/asio/strand.hpp> <boost/asio/thread_pool.hpp> <boost/asio/write.hpp>)
set(rooms_without_asio state json terrain elevation physics document map protocol rules match replay follow server_bots client_drawing)
set(rooms_with_asio server_logging server_timing server_frames server_stream server_room server_watchers server_records server_relay server_cluster server_proxies server_web server_net server_access server_admin server_metrics server_commands server
  client_terminal client_net client_play client_watch client)

# woodlouse_precompiled(TARGET PRIVATE HEADERS...) or (TARGET REUSE_FROM OTHER). A precompiled header serves whoever has the very
# flags it was made with: as optimised, where some are (WOODLOUSE_OPTIMISED).
function(woodlouse_precompiled target how other)
  if(how STREQUAL "REUSE_FROM")
    foreach(one ${target} ${other})
      if(one IN_LIST WOODLOUSE_OPTIMISED)
        set(${one}_is_optimised ON)
      endif()
    endforeach()
    if(NOT "${${target}_is_optimised}" STREQUAL "${${other}_is_optimised}")
      return()
    endif()
  endif()
  target_precompile_headers(${target} ${how} ${other} ${ARGN})
endfunction()

# Of a library; nothing where WOODLOUSE_UNITY is off.
function(woodlouse_unity target)
  if(WOODLOUSE_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  endif()
endfunction()

woodlouse_precompiled(woodlouse_core PRIVATE ${standard_headers})
foreach(room ${rooms_without_asio})
  if(TARGET woodlouse_${room})
    woodlouse_precompiled(woodlouse_${room} REUSE_FROM woodlouse_core)
  endif()
endforeach()
foreach(room json map protocol match replay follow client_drawing)
  if(TARGET woodlouse_${room})
    woodlouse_unity(woodlouse_${room})
  endif()
endforeach()
if(TARGET woodlouse_asio)
  woodlouse_precompiled(woodlouse_asio PRIVATE ${standard_headers} ${asio_headers})
  foreach(room ${rooms_with_asio})
    woodlouse_precompiled(woodlouse_${room} REUSE_FROM woodlouse_asio)
    woodlouse_unity(woodlouse_${room})
  endforeach()
  if(WOODLOUSE_UNITY)
    set_target_properties(woodlouse_server_options PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  endif()
endif()
