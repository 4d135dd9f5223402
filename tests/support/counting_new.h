// Counts every operator new of the test program, the aligned ones included.
#pragma once

#include <cstdint>

namespace bleedsim::test {

std::uint64_t allocationCount();

}  // namespace bleedsim::test
