// The thread that talks with the service: a force out, a state in, so many times a second. The
// thread of the host takes the latest state and leaves the latest force, and never waits.
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
  uint64_t sequence = 0, arrived_ns = 0;  // the time of monotonic_ns()
  bool force_on = false;
};

struct Force {
  double newton[3] = {};
  bool on = false;
};

class Exchange {
 public:
  explicit Exchange(const Options &options) : options_(options) {}
  // Says hello, and has a first sample when it returns MVS_DRIVER_OK; forces are off.
  int32_t open(const Inverse &inverse, const Grip &grip, Fault &fault);
  // Zero force, then goodbye.
  ~Exchange();
  // 0, or what pthread_setschedparam says.
  int wish_for_real_time();

  // The thread of the host.
  const Sample &latest() { return samples_.get(); }
  void put(const Force &force) { forces_.put(force); }
  // MVS_DRIVER_OK, or why the thread has ended; then `why` does not change any more.
  int32_t failure() const { return failure_.load(std::memory_order_acquire); }
  const char *why() const { return why_.sentence; }

  // Any thread.
  void allow(bool forces) { allowed_.store(forces, std::memory_order_release); }
  // A handler of a signal.
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
