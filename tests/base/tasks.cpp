// Tasks of one call: results, progress, the end by a callback, failures.
#include "base/tasks.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/workers.h"

using namespace mvs::core;

namespace {

const std::vector<double> steps = {0, 0.25, 0.5, 0.75};

// How often each task ran.
std::vector<int> counts_of(Workers *workers, uint32_t count, const TellShare &tell) {
  std::vector<int> counts(count, 0);
  run_tasks(workers, count, tell, [&](uint32_t task, const TellShare &tell_task) {
    for (const double share : steps) tell_task(share);
    ++counts[task];
  });
  return counts;
}

}  // namespace

TEST_CASE("each_task_runs_once_with_and_without_workers") {
  Workers three(3);
  for (Workers *workers : {static_cast<Workers *>(nullptr), &three}) {
    for (const uint32_t count : {0u, 1u, 2u, 50u}) {
      CHECK(counts_of(workers, count, {}) == std::vector<int>(count, 1));
    }
  }
}

TEST_CASE("progress_grows_and_is_told_on_the_calling_thread_only") {
  Workers three(3);
  const std::thread::id caller = std::this_thread::get_id();
  for (Workers *workers : {static_cast<Workers *>(nullptr), &three}) {
    std::vector<double> told;
    bool elsewhere = false;
    counts_of(workers, 40, [&](double share) {
      elsewhere = elsewhere || std::this_thread::get_id() != caller;
      told.push_back(share);
    });
    CHECK(!elsewhere);
    CHECK(std::is_sorted(told.begin(), told.end()));
    for (const double share : told) CHECK((share >= 0 && share <= 1));
    if (workers == nullptr) {
      // four shares and the end of each of 40 tasks
      REQUIRE(told.size() == 200);
      CHECK(told.front() == 0);
      CHECK(told.back() == 1);
    }
  }
}

TEST_CASE("progress_that_throws_ends_all_tasks_with_its_exception") {
  Workers three(3);
  for (Workers *workers : {static_cast<Workers *>(nullptr), &three}) {
    int calls = 0;
    const auto end = [&](double) {
      if (++calls == 3) throw std::runtime_error("enough");
    };
    CHECK_THROWS_WITH_AS(counts_of(workers, 1000, end), "enough", std::runtime_error);
    CHECK(calls == 3);
  }
}

TEST_CASE("the_failure_of_the_lowest_task_is_reported") {
  Workers three(3);
  for (Workers *workers : {static_cast<Workers *>(nullptr), &three}) {
    uint32_t reported = 0;
    try {
      run_tasks(workers, 100, {}, [](uint32_t task, const TellShare &) {
        if (task >= 7) throw task;
      });
    } catch (uint32_t task) {
      reported = task;
    }
    CHECK(reported == 7);
  }
}

TEST_CASE("tasks_inside_a_task_run_on_its_thread") {
  Workers three(3);
  std::vector<int> sums(6, 0);
  std::vector<uint8_t> elsewhere(6, 0);
  run_tasks(&three, 6, {}, [&](uint32_t task, const TellShare &tell_task) {
    const std::thread::id outer = std::this_thread::get_id();
    run_tasks(&three, 4, tell_task, [&](uint32_t inner, const TellShare &) {
      if (std::this_thread::get_id() != outer) elsewhere[task] = 1;
      sums[task] += static_cast<int>(inner);
    });
  });
  CHECK(sums == std::vector<int>(6, 6));
  CHECK(elsewhere == std::vector<uint8_t>(6, 0));
}
