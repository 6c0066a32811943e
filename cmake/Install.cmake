# What `cmake --install` puts where, and the package that find_package(woodlouse) finds.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/woodlouse)
set(data_folder ${CMAKE_INSTALL_DATADIR}/woodlouse)

# For players and hosts. The programs look for maps in ../share/woodlouse/maps, seen from themselves.
install(TARGETS woodlouse woodlouse-server woodlouse-swarm)
install(DIRECTORY maps DESTINATION ${data_folder})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY bots/python DESTINATION ${data_folder}
        FILES_MATCHING PATTERN "*.py" PATTERN "tests" EXCLUDE PATTERN "__pycache__" EXCLUDE)

# For programs of others: woodlouse::match and woodlouse::replay without Boost, woodlouse::bot with its headers.
set(rooms core state json terrain elevation physics document map protocol rules match replay follow)
foreach(room ${rooms})
  set_target_properties(woodlouse_${room} PROPERTIES EXPORT_NAME ${room})
  add_library(woodlouse::${room} ALIAS woodlouse_${room})
endforeach()
list(TRANSFORM rooms PREPEND woodlouse_ OUTPUT_VARIABLE libraries)
install(TARGETS ${libraries} woodlouse_flags woodlouse_zstd woodlouse-scenario EXPORT woodlouse)
set_target_properties(woodlouse_bot PROPERTIES EXPORT_NAME bot)
add_library(woodlouse::bot ALIAS woodlouse_bot)
install(TARGETS woodlouse_bot woodlouse_asio EXPORT woodlouse_bot)
install(DIRECTORY shared DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/woodlouse FILES_MATCHING PATTERN "*.h")
install(DIRECTORY bots/cpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/woodlouse/bots FILES_MATCHING PATTERN "*.h")
install(EXPORT woodlouse NAMESPACE woodlouse:: DESTINATION ${package_folder})
install(EXPORT woodlouse_bot NAMESPACE woodlouse:: DESTINATION ${package_folder})
configure_package_config_file(cmake/woodlouseConfig.cmake.in ${PROJECT_BINARY_DIR}/woodlouseConfig.cmake
                              INSTALL_DESTINATION ${package_folder} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/woodlouseConfigVersion.cmake COMPATIBILITY ExactVersion)
install(FILES ${PROJECT_BINARY_DIR}/woodlouseConfig.cmake ${PROJECT_BINARY_DIR}/woodlouseConfigVersion.cmake
        DESTINATION ${package_folder})
