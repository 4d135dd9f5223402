#include <csignal>
#include <cstdio>
#include <exception>
#include <fmt/core.h>

#include "clients/bleedctl/context.h"

int main(int argc, char** argv) {
  // A limit to the size of files is to be an error with a message, as a full disk is.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return bleedsim::bleedctl::runBleedctl(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bleedctl: {}\n", error.what());
    return bleedsim::bleedctl::kFailed;
  }
}
