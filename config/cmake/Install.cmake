# Two components. "client": what a front end links (static libraries, headers, CMake package). "daemon": bleedd, bleedctl, scenes,
# the systemd unit, the kernel setting and configurations of Cyclone DDS. cmake --install build --prefix DIR [--component client]
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

install(TARGETS bleedd bleedctl RUNTIME DESTINATION bin COMPONENT daemon)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/config/scenes" DESTINATION share/bleedsim COMPONENT daemon
        FILES_MATCHING PATTERN "*.textproto")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/config/dds" DESTINATION share/bleedsim COMPONENT daemon FILES_MATCHING PATTERN "*.xml")
install(FILES "${PROJECT_SOURCE_DIR}/config/systemd/session.conf.example" DESTINATION share/bleedsim COMPONENT daemon)
# systemd looks for both below /usr and /usr/local.
install(FILES "${PROJECT_SOURCE_DIR}/config/systemd/60-bleedsim.conf" DESTINATION lib/sysctl.d COMPONENT daemon)
# A unit holds absolute paths, and only the installation knows its prefix.
install(CODE "
  set(BLEEDSIM_PREFIX \"\${CMAKE_INSTALL_PREFIX}\")
  set(unit \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/lib/systemd/system/bleedd@.service\")
  message(STATUS \"Installing: \${unit}\")
  configure_file(\"${PROJECT_SOURCE_DIR}/config/systemd/bleedd@.service.in\" \"\${unit}\" @ONLY)
  list(APPEND CMAKE_INSTALL_MANIFEST_FILES \"\${CMAKE_INSTALL_PREFIX}/lib/systemd/system/bleedd@.service\")
" COMPONENT daemon)
install(FILES "${PROJECT_SOURCE_DIR}/config/recording/foxglove_layout.json" DESTINATION share/bleedsim/recording COMPONENT daemon)
