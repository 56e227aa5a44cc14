// One loop at a time, whose chunks are claimed from a counter. A thread joins the loop under a
// mutex and claims chunks until none is left; the caller closes the loop to latecomers and waits
// for those inside.
#include "base/workers.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/denormals.h"
#include "base/own_faults_only.h"

namespace mvs::core {
namespace {

// Shorter loops are not shared: to wake a thread takes tens of microseconds.
constexpr double least_shared_us = 60;
// A thread waits so long before it sleeps: longer than the gaps between most loops of a closure,
// short enough to leave its core to others.
constexpr std::chrono::microseconds longest_spin{40};

double least_from_environment() {
  const char *text = std::getenv("MVS_WORKERS_LEAST_US");  // NOLINT(concurrency-mt-unsafe)
  return text == nullptr ? least_shared_us : std::strtod(text, nullptr);
}

// Waits until `done()`, at most longest_spin; returns whether it is.
template <typename Done>
bool spin(const Done &done) {
  const auto end = std::chrono::steady_clock::now() + longest_spin;
  for (;;) {
    for (int k = 0; k < 64; ++k) {
      if (done()) return true;
    }
    if (std::chrono::steady_clock::now() > end) return done();
    std::this_thread::yield();
  }
}

}  // namespace

// The loop that is shared at present. Its threads read it between join and leave only.
struct Workers::Loop {
  void (*run)(const void *, uint32_t) = nullptr;
  const void *context = nullptr;
  uint32_t count = 0;
  FloatingPointMode mode;
  std::atomic<uint32_t> next{0};  // chunk to be claimed
  std::mutex failed;              // protects the next two
  uint32_t failed_chunk = 0;
  std::exception_ptr error;

  // A failure leaves out the unclaimed chunks, which all come after the claimed ones.
  void work() {
    const FloatingPointMode::Scope scope(mode);
    for (uint32_t k; (k = next.fetch_add(1, std::memory_order_relaxed)) < count;) {
      try {
        run(context, k);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(failed);
        if (!error || k < failed_chunk) {
          error = std::current_exception();
          failed_chunk = k;
        }
        next.store(count, std::memory_order_relaxed);
      }
    }
  }
};

struct Workers::Team {
  std::mutex mutex;  // protects the state of the loop
  std::condition_variable wake, left;
  std::atomic<uint64_t> loops{0};   // so far
  std::atomic<uint32_t> inside{0};  // threads in the loop
  std::atomic<bool> is_open{false}, ends{false};
  uint32_t asleep = 0;
  Loop loop;
  std::vector<std::thread> threads;
  bool started = false;
  std::atomic<bool> busy{false};  // from before the loop opens until its last thread has left

  ~Team() {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      ends = true;
    }
    wake.notify_all();
    for (std::thread &t : threads) t.join();
  }

  // Joins the open loop, if there is one, and works on it.
  void help() {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!is_open) return;
      ++inside;
    }
    loop.work();
    const std::lock_guard<std::mutex> lock(mutex);
    if (--inside == 0) left.notify_all();
  }

  void serve() {
    uint64_t seen = 0;
    const auto has_work = [&] { return ends || loops != seen; };
    while (!ends) {
      if (!spin(has_work)) {
        std::unique_lock<std::mutex> lock(mutex);
        ++asleep;
        wake.wait(lock, has_work);
        --asleep;
      }
      seen = loops;
      if (!ends) help();
    }
  }

  // A system without a thread to spare has fewer workers.
  void start(uint32_t count) {
    if (started) return;
    started = true;
    const OwnFaultsOnly blocked;
    threads.reserve(count);
    try {
      while (threads.size() < count) threads.emplace_back([this] { serve(); });
    } catch (const std::system_error &) {
      return;
    }
  }

  void open(uint32_t count, void (*run)(const void *, uint32_t), const void *context) {
    bool wakes = false;
    {
      const std::lock_guard<std::mutex> lock(mutex);
      loop.run = run;
      loop.context = context;
      loop.count = count;
      loop.mode = FloatingPointMode::current();
      loop.next = 0;
      loop.error = nullptr;
      is_open = true;
      ++loops;
      wakes = asleep > 0;
    }
    if (wakes) wake.notify_all();
  }

  // Waits for the threads inside; later ones find no loop.
  void close() {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      is_open = false;
    }
    if (spin([&] { return inside == 0; })) return;
    std::unique_lock<std::mutex> lock(mutex);
    left.wait(lock, [&] { return inside == 0; });
  }
};

Workers::Workers(uint32_t count)
    : width_(std::clamp(count, 1u, most)), least_(least_from_environment()) {
#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
  width_ = 1;
#endif
  if (width_ > 1) team_ = std::make_unique<Team>();
}

Workers::Workers(const HostPool &pool)
    : least_(least_from_environment()), host_(pool), team_(std::make_unique<Team>()) {}

Workers::~Workers() = default;

void Workers::begin_call() {
  if (host_.width != nullptr) width_ = std::clamp(host_.width(host_.user), 1u, most);
}

void Workers::share(uint32_t count, void (*run)(const void *, uint32_t), const void *context) {
  if (width_ < 2 || count < 2 || team_->busy) {
    for (uint32_t k = 0; k < count; ++k) run(context, k);
    return;
  }
  if (host_.run == nullptr) team_->start(width_ - 1);
  team_->busy = true;
  team_->open(count, run, context);
  std::exception_ptr of_host;
  try {
    if (host_.run != nullptr) run_by_host(std::min(width_, count));
  } catch (...) {
    of_host = std::current_exception();
  }
  team_->loop.work();
  team_->close();
  team_->busy = false;
  const std::exception_ptr error = std::exchange(team_->loop.error, nullptr);
  if (error) std::rethrow_exception(error);
  if (of_host) std::rethrow_exception(of_host);
}

void Workers::run_by_host(uint32_t helpers) {
  host_.run(
      host_.user, helpers, [](void *team, uint32_t) { static_cast<Team *>(team)->help(); },
      team_.get());
}

}  // namespace mvs::core
