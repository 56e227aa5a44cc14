// Runs independent jobs in several processes, each a copy of this one (fork).
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace cli {

// The number of cores that this process may use.
unsigned core_count();

// Calls work(k) for k from 0 to jobs - 1 in `processes` copies of this process, and take(k, result)
// in this one as each ends, in any order. A result has no line break. Stops early on Ctrl-C. Throws
// mvs::Error if a process ends by itself; results taken before are valid. No other thread of this
// process may run.
void run_in_processes(size_t jobs, unsigned processes,
                      const std::function<std::string(size_t)> &work,
                      const std::function<void(size_t, const std::string &)> &take);

}  // namespace cli
