# pass_report.cmake: a line for every table; every bound fails the report by itself, none where the bounds are off; what this machine
# cannot measure is left out.
#   cmake -DREPORT=... -DSIZE=... -DNM=... -DOBJECTS="a.o,b.o" -P
function(report expected_to_fail wanted)
  execute_process(COMMAND "${CMAKE_COMMAND}" "-DOBJECTS=${OBJECTS}" ${ARGN} -P "${REPORT}" RESULT_VARIABLE failed
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed AND NOT expected_to_fail)
    message(FATAL_ERROR "the report fails with ${ARGN}: ${output}")
  elseif(NOT failed AND expected_to_fail)
    message(FATAL_ERROR "the report passes with ${ARGN}: ${output}")
  endif()
  foreach(text IN LISTS wanted)
    if(NOT output MATCHES "${text}")
      message(FATAL_ERROR "no '${text}' with ${ARGN} in: ${output}")
    endif()
  endforeach()
endfunction()

set(lines "passes_bounded: " "passes_literal_float: " "passes_double: " "sweeps_float: " "code of the passes: sound ")
report(FALSE "${lines}" -DSIZE= -DNM=/nowhere/nm -DBOUNDED=ON)
if(NM)
  report(FALSE "passes_literal_double: 102 instantiations .at most 94 sets" "-DNM=${NM}" "-DSIZE=${SIZE}" -DBOUNDED=OFF -DMOST_SETS=1)
  report(TRUE "passes_literal_double: 94 sets of effects, at most 93 are allowed" "-DNM=${NM}" "-DSIZE=${SIZE}" -DBOUNDED=ON -DMOST_SETS=93)
endif()
if(SIZE)
  report(FALSE "${lines};[0-9]+ bytes of code" "-DSIZE=${SIZE}" "-DNM=${NM}" -DBOUNDED=OFF)
  report(TRUE "sound passes: [0-9]+ bytes of code, at most 1000 are allowed" "-DSIZE=${SIZE}" -DBOUNDED=ON -DMOST_SOUND_BYTES=1000)
  report(TRUE "literal passes: [0-9]+ bytes of code, at most 1000 are allowed" "-DSIZE=${SIZE}" -DBOUNDED=ON -DMOST_LITERAL_BYTES=1000)
endif()

# What measure_compile noted, beside objects that only have the name of one.
set(folder "${CMAKE_CURRENT_BINARY_DIR}/pass_report_test/passes")
file(WRITE "${folder}/passes_slow.cpp.o" "no object")
file(WRITE "${folder}/passes_slow.cpp.o.cost" "181.5 976563 compiled\n")
set(OBJECTS "${folder}/passes_slow.cpp.o")
report(FALSE "181.5 s of CPU and 953 MiB to compile .compiled." "-DSIZE=${SIZE}" "-DNM=${NM}" -DBOUNDED=OFF)
report(TRUE "181.5 seconds of CPU time, at most 180;976563 KiB to compile, at most 976562" "-DSIZE=${SIZE}" "-DNM=${NM}" -DBOUNDED=ON)
file(WRITE "${folder}/passes_slow.cpp.o.cost" "- - cached\n")
report(FALSE "- s of CPU and - MiB to compile .cached." "-DSIZE=${SIZE}" "-DNM=${NM}" -DBOUNDED=ON)
