# Compiler settings of every target, carried by the interface target bleedsim_options.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_C_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()

add_library(bleedsim_options INTERFACE)
# psabi: calls that pass the compiler's own vectors, wider than the baseline's (service/sph/quad.h), are between objects of one baseline.
# Contraction would let the compiler fuse a*b+c where it likes: results would depend on its mood. No fast-math, ever.
target_compile_options(bleedsim_options INTERFACE -ffp-contract=off
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-align -Woverloaded-virtual
                            -Wconversion -Wno-sign-conversion -Wdouble-promotion -Wno-psabi>)
if(BLEEDSIM_WERROR)
  target_compile_options(bleedsim_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Werror>)
endif()

if(BLEEDSIM_SANITIZE STREQUAL "address")
  set(sanitize -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer -g)
elseif(BLEEDSIM_SANITIZE STREQUAL "thread")
  set(sanitize -fsanitize=thread -fno-omit-frame-pointer -g)
  target_compile_definitions(bleedsim_options INTERFACE BLEEDSIM_STD_THREADS)
elseif(BLEEDSIM_SANITIZE)
  message(FATAL_ERROR "BLEEDSIM_SANITIZE is '${BLEEDSIM_SANITIZE}'; use '', 'address' or 'thread'")
endif()
if(BLEEDSIM_SANITIZE)
  target_compile_options(bleedsim_options INTERFACE ${sanitize})
  target_link_options(bleedsim_options INTERFACE ${sanitize})
endif()
