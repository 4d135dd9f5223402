option(BLEEDSIM_PASS_BOUNDS "Fail a release build whose pass tables are beyond their bounds" ON)

# bleedsim_report_passes(TARGET): after the target is linked, prints for each of its pass tables the instantiations, seconds and
# memory of the compilation, and bytes of code, and fails beyond the bounds of pass_report.cmake. What this machine cannot measure is
# left out. The target's property BLEEDSIM_OBJECT_LIST is a file that names its objects, one in a line.
function(bleedsim_report_passes target)
  set(source "${PROJECT_SOURCE_DIR}/config/cmake/measure_compile.cpp")
  set(launcher "${PROJECT_BINARY_DIR}/measure_compile")
  if(NOT CMAKE_CROSSCOMPILING AND (NOT EXISTS "${launcher}" OR "${source}" IS_NEWER_THAN "${launcher}"))
    try_compile(BLEEDSIM_MEASURES_COMPILATIONS SOURCES "${source}" COPY_FILE "${launcher}" COPY_FILE_ERROR ignored)
  endif()
  if(EXISTS "${launcher}")
    set(command "${launcher}" "/passes/" ${CMAKE_CXX_COMPILER_LAUNCHER})
    set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER "${command}")
  endif()
  find_program(BLEEDSIM_SIZE NAMES size llvm-size)
  mark_as_advanced(BLEEDSIM_SIZE)
  set(bounded ${BLEEDSIM_PASS_BOUNDS})
  if(BLEEDSIM_SANITIZE OR NOT CMAKE_BUILD_TYPE STREQUAL "Release")
    set(bounded OFF) # sanitizers and debug builds blow code up
  endif()
  set(list "${CMAKE_CURRENT_BINARY_DIR}/${target}_objects.txt")
  file(GENERATE OUTPUT "${list}" CONTENT "$<JOIN:$<TARGET_OBJECTS:${target}>,\n>\n")
  set_target_properties(${target} PROPERTIES BLEEDSIM_OBJECT_LIST "${list}")
  add_custom_command(
    TARGET ${target} POST_BUILD
    COMMAND "${CMAKE_COMMAND}" "-DSIZE=${BLEEDSIM_SIZE}" "-DNM=${CMAKE_NM}" -DBOUNDED=${bounded}
            "-DOBJECT_LIST=${list}" -P "${PROJECT_SOURCE_DIR}/config/cmake/pass_report.cmake"
    VERBATIM)
endfunction()
