// A thread on which a driver is called, so that one that hangs does not take its caller with it.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace mvs::core {

// Runs one piece of work after the other, all on one thread: vendors' libraries keep things for
// each thread. Work that does not come back in time leaves the worker stuck for ever; its thread
// stays behind, so what the work uses has to be owned by it.
class Worker {
 public:
  Worker();
  ~Worker();
  Worker(const Worker &) = delete;
  Worker &operator=(const Worker &) = delete;

  // False if it did not come back in time, or is stuck from before. Nothing may be thrown by it.
  bool run(std::function<void()> work, std::chrono::milliseconds patience);
  bool is_stuck() const { return stuck_; }

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
  bool stuck_ = false;
};

}  // namespace mvs::core
