// Independent jobs on several threads: whole runs scale better than the steps of one.
#pragma once

#include <cstddef>
#include <functional>

namespace bleedsim::lab {

/// Calls job(k) once for each k in [0, jobs), on at most `threads` threads, and `done(finished)` after each, never twice at a
/// time. Returns when all have ended. Neither may throw.
void runSideBySide(std::size_t jobs, int threads, const std::function<void(std::size_t)>& job,
                   const std::function<void(std::size_t)>& done);

}  // namespace bleedsim::lab
