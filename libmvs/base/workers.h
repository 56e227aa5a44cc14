// Worker threads of one simulator: share the chunks of a loop between the calling thread and
// threads of the library, or of a host's pool.
//
// A chunk writes only to places of its own, so that no result depends on the number of workers, on
// the order of chunks, or on which thread runs one. Threads start with the first loop. A thread
// without work waits briefly in a loop, then sleeps. Chunks run in the floating-point mode of the
// calling thread. A loop inside a chunk runs on that chunk's thread alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace mvs::core {

// A pool of the host: mvs_sim_desc describes its callbacks.
struct HostPool {
  uint32_t (*width)(void *user) = nullptr;
  void (*run)(void *user, uint32_t count, void (*task)(void *context, uint32_t index),
              void *context) = nullptr;
  void *user = nullptr;
};

class Workers {
 public:
  static constexpr uint32_t most = 256;

  // The calling thread and count - 1 threads of the library, if the system grants them.
  explicit Workers(uint32_t count);
  // A pool that runs fewer tasks than it is asked to, runs them late or on one thread, or throws,
  // changes no result: the calling thread runs the chunks that are left.
  explicit Workers(const HostPool &pool);
  Workers(const Workers &) = delete;
  Workers &operator=(const Workers &) = delete;
  ~Workers();  // joins the threads

  // Asks a host's pool for its width, which holds until the next call.
  void begin_call();
  // Threads that may share a loop, the calling one included.
  uint32_t width() const { return width_; }
  // Whether a loop of about this duration is worth sharing. The environment variable
  // MVS_WORKERS_LEAST_US replaces the shortest one, for tests on small valves.
  bool pay_for(double microseconds) const { return width_ > 1 && microseconds >= least_; }

  // Calls run(chunk) for each chunk below `count`, in any order and at the same time, and returns
  // when all have returned. If some throw, rethrows the exception of the lowest chunk.
  template <typename Run>
  void parallel_for(uint32_t count, const Run &run) {
    share(
        count,
        [](const void *context, uint32_t chunk) { (*static_cast<const Run *>(context))(chunk); },
        &run);
  }

 private:
  struct Loop;
  struct Team;
  void share(uint32_t count, void (*run)(const void *, uint32_t), const void *context);
  void run_by_host(uint32_t helpers);

  uint32_t width_ = 1;
  double least_ = 0;  // microseconds
  HostPool host_;
  std::unique_ptr<Team> team_;
};

// Whether to share a loop of about this duration. No workers: no.
inline bool pay_for(const Workers *workers, double microseconds) {
  return workers != nullptr && workers->pay_for(microseconds);
}

// The begin of part `part` of `count` things divided into `parts` equal ones.
inline uint32_t begin_of_part(uint32_t part, uint32_t parts, size_t count) {
  return static_cast<uint32_t>(uint64_t{part} * count / parts);
}

}  // namespace mvs::core
