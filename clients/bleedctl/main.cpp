#include <cstdio>
#include <exception>
#include <fmt/core.h>

#include "clients/bleedctl/context.h"

int main(int argc, char** argv) {
  try {
    return bleedsim::bleedctl::runBleedctl(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bleedctl: {}\n", error.what());
    return bleedsim::bleedctl::kFailed;
  }
}
