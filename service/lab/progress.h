// Progress on stderr: a line that rewrites itself on a terminal, silence elsewhere.
#pragma once

#include <string>

namespace bleedsim::lab {

class Progress {
 public:
  explicit Progress(std::string name);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `part` of the work is done, 0 to 1.
  void report(double part);

 private:
  std::string name_;
  bool terminal_;
  int shown_ = -1;
};

}  // namespace bleedsim::lab
