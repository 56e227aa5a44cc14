// Tasks of one call that are independent and run at the same time on the workers of a simulator.
#pragma once

#include <cstdint>
#include <functional>

namespace mvs::core {

class Workers;

// Receives the share that is done, in [0, 1]; may throw to end the call.
using TellShare = std::function<void(double share)>;

// Calls run(task, tell_task) for each task below `count`. Null workers: one after another. A task
// tells its own share from time to time; `tell` then receives that of all tasks, on the calling
// thread only. If `tell` throws, each task ends when it next tells, and its exception is rethrown;
// if tasks throw, the exception of the lowest one is.
void run_tasks(Workers *workers, uint32_t count, const TellShare &tell,
               const std::function<void(uint32_t task, const TellShare &tell_task)> &run);

}  // namespace mvs::core
