// The thread that exchanges forces and states with the service at a fixed rate. The host's thread
// reads the latest state and writes the latest force without waiting.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "connection.h"
#include "latest.h"

namespace haply {

struct Sample {
  Hand hand;
  uint64_t sequence = 0, arrived_ns = 0;  // by monotonic_ns()
  bool force_on = false;
};

struct Force {
  double newton[3] = {};
  bool on = false;
};

class Exchange {
 public:
  explicit Exchange(const Options &options) : options_(options) {}
  // Starts the session with forces off; on MVS_DRIVER_OK a first sample is available.
  int32_t open(const Inverse &inverse, const Grip &grip, Fault &fault);
  // Sends zero force and closes the connection.
  ~Exchange();
  // Returns the result of pthread_setschedparam, 0 on success.
  int request_real_time();

  // For the host's thread.
  const Sample &latest() { return samples_.get(); }
  void put(const Force &force) { forces_.put(force); }
  // MVS_DRIVER_OK, or the error that ended the thread; why() is then constant.
  int32_t failure() const { return failure_.load(std::memory_order_acquire); }
  const char *why() const { return why_.sentence; }

  // For any thread.
  void allow(bool forces) { allowed_.store(forces, std::memory_order_release); }
  // For a signal handler.
  void panic();

  Connection connection;

 private:
  void work();
  int32_t talk();
  int32_t tick(Force force);
  int32_t listen(Force force);
  bool keep_asking(Force &force, bool answered);
  bool say(const Force &force);
  int32_t silent();
  Force wanted();

  const Options &options_;
  std::string device_, panic_frame_, text_;
  Grip grip_;
  Sample sample_;
  std::unique_ptr<Commands> commands_;
  Latest<Sample> samples_;
  Latest<Force> forces_;
  std::atomic<bool> allowed_{false}, ending_{false};
  std::atomic<int> descriptor_{-1};
  std::atomic<int32_t> failure_{MVS_DRIVER_OK};
  Fault why_;
  std::thread thread_;
};

}  // namespace haply
