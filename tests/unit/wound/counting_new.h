// Counts every operator new of the test program.
#pragma once

#include <cstdint>

std::uint64_t allocationCount();
