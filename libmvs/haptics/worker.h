// A thread on which a driver is called, so that a hanging driver does not block its caller for
// ever.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace mvs::core {

// Runs work items one after the other on one thread, because vendors' libraries keep thread-local
// state. An item that does not return in time leaves the worker stuck: its thread stays, so that
// the work must own all data it uses.
class Worker {
 public:
  Worker();
  ~Worker();
  Worker(const Worker &) = delete;
  Worker &operator=(const Worker &) = delete;

  // Returns false if the work does not return in time or the worker is stuck. The work must not
  // throw.
  bool run(std::function<void()> work, std::chrono::milliseconds timeout);
  bool is_stuck() const { return stuck_; }

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
  bool stuck_ = false;
};

}  // namespace mvs::core
