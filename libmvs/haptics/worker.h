// A thread on which a driver is called, so that a hanging driver does not block its caller for
// ever.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>

namespace mvs::core {

// Runs work items one after the other on one thread, because vendors' libraries keep thread-local
// state. An item that does not return in time leaves the worker stuck: its thread stays, and this
// library stays loaded for it, so that the work must own all data it uses. Otherwise the destructor
// joins the thread.
class Worker {
 public:
  // `driver` is named in the sentence of a failure: MVS_E_MEMORY if the system has no thread.
  explicit Worker(const std::string &driver);
  ~Worker();
  Worker(const Worker &) = delete;
  Worker &operator=(const Worker &) = delete;

  // Returns false if the work does not return in time or the worker is stuck. The work must not
  // throw.
  bool run(std::function<void()> work, std::chrono::milliseconds timeout);
  bool is_stuck() const { return stuck_; }
  // Leaves this library loaded for ever, for another thread that hangs in the driver.
  void keep_library() { keeps_library_ = true; }

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
  void *library_;
  std::thread thread_;
  bool stuck_ = false, keeps_library_ = false;
};

}  // namespace mvs::core
