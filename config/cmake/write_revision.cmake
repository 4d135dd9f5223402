# cmake -DSOURCE_DIR=... -DHEADER=... -P write_revision.cmake
# Writes the revision of the sources into a C++ header: the commit's hash, with -dirty when tracked files differ from it, or
# "unknown" without git or from an archive. An unchanged header is left alone, so that nothing is compiled again.
cmake_minimum_required(VERSION 3.25)

set(revision "unknown")
# Only a repository of our own counts: an unpacked archive may lie within another one.
if(EXISTS "${SOURCE_DIR}/.git")
  # safe.directory: root may build a checkout of someone else. No locks: a build must not disturb the user's git.
  execute_process(
    COMMAND git --no-optional-locks -c safe.directory=* -C "${SOURCE_DIR}" describe --always --dirty --abbrev=12 --exclude=*
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(failed STREQUAL "0" AND described)
    set(revision "${described}")
  endif()
endif()
# file(CONFIGURE) writes only what differs.
file(CONFIGURE OUTPUT "${HEADER}" @ONLY CONTENT
"// Written by config/cmake/write_revision.cmake at each build.
#pragma once

namespace bleedsim {

inline constexpr const char* kRevision = \"@revision@\";

}  // namespace bleedsim
")
