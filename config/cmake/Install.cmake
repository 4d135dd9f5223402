# Two components. "client": what a front end links (static libraries, headers, CMake package). "programs": bleedd, bleedctl and
# the scenes. cmake --install build --prefix DIR [--component client]
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(BLEEDSIM_INSTALL_INCLUDE "${CMAKE_INSTALL_INCLUDEDIR}/bleedsim-1")
set(BLEEDSIM_INSTALL_CMAKE "${CMAKE_INSTALL_LIBDIR}/cmake/bleedsim")

set(client_targets)
foreach(name client recording transport idl status)
  list(APPEND client_targets bleedsim_${name})
  set_target_properties(bleedsim_${name} PROPERTIES EXPORT_NAME ${name})
endforeach()
target_compile_features(bleedsim_client PUBLIC cxx_std_20)
target_include_directories(bleedsim_client INTERFACE "$<INSTALL_INTERFACE:${BLEEDSIM_INSTALL_INCLUDE}>")

install(TARGETS ${client_targets} EXPORT bleedsimTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT client)
install(EXPORT bleedsimTargets NAMESPACE bleedsim:: DESTINATION "${BLEEDSIM_INSTALL_CMAKE}" COMPONENT client)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/clients/lib/include/bleedsim" DESTINATION "${BLEEDSIM_INSTALL_INCLUDE}" COMPONENT client)
install(FILES "${PROJECT_SOURCE_DIR}/service/status/status.h" DESTINATION "${BLEEDSIM_INSTALL_INCLUDE}/service/status"
        COMPONENT client)

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/bleedsimConfig.cmake.in" "${PROJECT_BINARY_DIR}/bleedsimConfig.cmake"
                              INSTALL_DESTINATION "${BLEEDSIM_INSTALL_CMAKE}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/bleedsimConfigVersion.cmake" COMPATIBILITY SameMajorVersion)
install(FILES "${PROJECT_BINARY_DIR}/bleedsimConfig.cmake" "${PROJECT_BINARY_DIR}/bleedsimConfigVersion.cmake"
        DESTINATION "${BLEEDSIM_INSTALL_CMAKE}" COMPONENT client)

install(TARGETS bleedd bleedctl RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT programs)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/config/scenes" DESTINATION "${CMAKE_INSTALL_DATADIR}/bleedsim" COMPONENT programs
        FILES_MATCHING PATTERN "*.textproto")
install(FILES "${PROJECT_SOURCE_DIR}/config/recording/foxglove_layout.json" DESTINATION "${CMAKE_INSTALL_DATADIR}/bleedsim/recording"
        COMPONENT programs)
