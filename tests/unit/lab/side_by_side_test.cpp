// Every job runs once, whatever the number of threads.
#include "service/lab/side_by_side.h"

#include <gtest/gtest.h>
#include <vector>

namespace bleedsim::lab {
namespace {

TEST(RunSideBySide, RunsEveryJobOnceAndCountsThem) {
  for (const int threads : {0, 1, 3, 20}) {
    std::vector<int> ran(12, 0);
    std::vector<std::size_t> counted;
    runSideBySide(
        ran.size(), threads, [&](std::size_t k) { ++ran[k]; }, [&](std::size_t done) { counted.push_back(done); });
    EXPECT_EQ(ran, std::vector<int>(12, 1)) << threads;
    ASSERT_EQ(counted.size(), 12u) << threads;
    for (std::size_t k = 0; k < counted.size(); ++k) EXPECT_EQ(counted[k], k + 1);
  }
}

TEST(RunSideBySide, OfNothingIsNothing) {
  runSideBySide(
      0, 4, [](std::size_t) { ADD_FAILURE(); }, [](std::size_t) { ADD_FAILURE(); });
}

}  // namespace
}  // namespace bleedsim::lab
