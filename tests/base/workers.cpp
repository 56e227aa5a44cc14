// Loops on worker threads: each chunk once, failures, loops inside loops, and pools of hosts that
// break their contract.
#include "base/workers.h"

#include <doctest/doctest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/denormals.h"

using namespace mvs::core;

namespace {

using Task = void (*)(void *, uint32_t);

// Runs a loop, and returns how often each chunk ran.
std::vector<int> counts_of(Workers &workers, uint32_t chunks) {
  std::vector<int> counts(chunks, 0);
  workers.parallel_for(chunks, [&](uint32_t k) { ++counts[k]; });
  return counts;
}

bool each_once(Workers &workers, uint32_t chunks) {
  return counts_of(workers, chunks) == std::vector<int>(chunks, 1);
}

// The chunk whose failure a loop reports; chunk `first` and each third one after it fail.
uint32_t reported(Workers &workers, uint32_t first) {
  try {
    workers.parallel_for(200, [&](uint32_t k) {
      if (k >= first && (k - first) % 3 == 0) throw k;
    });
  } catch (uint32_t chunk) {
    return chunk;
  }
  return 0;
}

uint32_t width_of_three(void *) {
  return 3;
}

HostPool host(void (*run)(void *, uint32_t, Task, void *), void *pool = nullptr) {
  return {&width_of_three, run, pool};
}

void run_backwards(void *, uint32_t count, Task task, void *context) {
  while (count > 0) task(context, --count);
}

void run_nothing(void *, uint32_t, Task, void *) {}

void run_twice(void *, uint32_t count, Task task, void *context) {
  for (uint32_t k = 0; k < 2 * count; ++k) task(context, k / 2);
}

// Starts threads that outlive the call, and may run their task after the loop.
void run_late(void *pool, uint32_t count, Task task, void *context) {
  auto &threads = *static_cast<std::vector<std::thread> *>(pool);
  for (uint32_t k = 0; k < count; ++k) {
    threads.emplace_back([=] { task(context, k); });
  }
}

void run_and_throw(void *, uint32_t, Task task, void *context) {
  task(context, 0);
  throw std::runtime_error("of the host");
}

}  // namespace

TEST_CASE("each chunk of a loop runs once, whatever the number of workers") {
  for (const uint32_t width : {0u, 1u, 2u, 3u, 8u, 1000u}) {
    Workers workers(width);
    CHECK(workers.width() <= Workers::most);
    for (const uint32_t chunks : {0u, 1u, 2u, 7u, 100000u}) CHECK(each_once(workers, chunks));
  }
}

TEST_CASE("a pool is used for thousands of short loops") {
  Workers workers(3);
  uint64_t sum = 0;
  std::vector<uint64_t> parts(5);
  for (uint64_t loop = 0; loop < 3000; ++loop) {
    workers.parallel_for(5, [&](uint32_t k) { parts[k] = loop + k; });
    sum += std::accumulate(parts.begin(), parts.end(), uint64_t{0});
  }
  CHECK(sum == 3000u * 2999u / 2 * 5 + 3000u * 10);
}

TEST_CASE("the failure of the first chunk that fails is reported, and the pool works on") {
  for (const uint32_t width : {1u, 2u, 8u}) {
    Workers workers(width);
    for (const uint32_t first : {1u, 2u, 50u, 199u}) {
      CHECK(reported(workers, first) == first);
      CHECK(each_once(workers, 100));
    }
  }
}

TEST_CASE("a loop inside a chunk runs on the thread of the chunk") {
  Workers workers(4);
  std::vector<std::vector<int>> counts(20, std::vector<int>(30, 0));
  std::atomic<int> elsewhere{0};
  workers.parallel_for(20, [&](uint32_t i) {
    const auto own = std::this_thread::get_id();
    workers.parallel_for(30, [&](uint32_t j) {
      ++counts[i][j];
      if (std::this_thread::get_id() != own) ++elsewhere;
    });
  });
  CHECK(counts == std::vector<std::vector<int>>(20, std::vector<int>(30, 1)));
  CHECK(elsewhere == 0);
}

TEST_CASE("no thread starts before a loop that has two chunks") {
  Workers workers(8);
  const auto own = std::this_thread::get_id();
  workers.parallel_for(1, [&](uint32_t) { CHECK(std::this_thread::get_id() == own); });
  CHECK(each_once(workers, 8));
}

#if defined(MVS_HAVE_MXCSR)
TEST_CASE("chunks run in the floating-point mode of the caller") {
  Workers workers(4);
  const FlushDenormals flush;
  const unsigned mode = _mm_getcsr() & 0xffc0u;  // without the flags of exceptions
  std::atomic<int> others{0};
  for (int loop = 0; loop < 50; ++loop) {
    workers.parallel_for(64, [&](uint32_t) { others += (_mm_getcsr() & 0xffc0u) != mode; });
  }
  CHECK(others == 0);
}
#endif

TEST_CASE("a host's pool may run tasks backwards, twice or never") {
  for (auto *run : {&run_backwards, &run_nothing, &run_twice}) {
    Workers workers(host(run));
    CHECK(workers.width() == 1);
    workers.begin_call();
    CHECK(workers.width() == 3);
    for (const uint32_t chunks : {0u, 1u, 2u, 1000u}) CHECK(each_once(workers, chunks));
    CHECK(reported(workers, 50) == 50);
  }
}

TEST_CASE("a host's pool may run tasks after its call has returned") {
  std::vector<std::thread> threads;
  Workers workers(host(&run_late, &threads));
  workers.begin_call();
  for (int loop = 0; loop < 50; ++loop) CHECK(each_once(workers, 100));
  for (std::thread &t : threads) t.join();
}

TEST_CASE("an exception of a host's pool is rethrown after the loop") {
  Workers workers(host(&run_and_throw));
  workers.begin_call();
  std::vector<int> counts(100, 0);
  CHECK_THROWS_AS(workers.parallel_for(100, [&](uint32_t k) { ++counts[k]; }), std::runtime_error);
  CHECK(counts == std::vector<int>(100, 1));
}

TEST_CASE("only loops that are long enough are shared") {
  CHECK(!pay_for(nullptr, 1e9));
  const Workers one(1), two(2);
  CHECK(!one.pay_for(1e9));
  CHECK(two.pay_for(1e9));
  CHECK(!two.pay_for(1));
}
