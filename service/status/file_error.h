// Files that the system refuses: its reason, and the way out.
#pragma once

#include <cerrno>
#include <string>
#include <system_error>

namespace bleedsim {

/// What a person who wants to write a file can do about a value of errno, behind a semicolon; empty where there is no telling.
inline const char* fileAdvice(int error) {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      return "; create its folder first";
    case EACCES:
    case EPERM:
    case EROFS:
      return "; choose a file in a folder that you may write to";
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "; free space or choose another disk";
    case EISDIR:
      return "; it is a folder: give the name of a file";
    default:
      return "";
  }
}

/// "No such file or directory; create its folder first".
inline std::string fileErrorText(int error) { return std::generic_category().message(error) + fileAdvice(error); }

}  // namespace bleedsim
