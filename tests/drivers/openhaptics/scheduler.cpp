// The stand-in's scheduler: one thread that calls each callback once a tick, the highest priority
// first, until the callback reports that it is done.
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <thread>

#include "inside.h"

namespace hd {
namespace {

using Clock = std::chrono::steady_clock;

struct Job {
  unsigned long ticket;
  unsigned (*call)(void *);
  void *user;
  unsigned short priority;
  std::atomic<bool> done{false}, calling{false};
};

struct Scheduler {
  std::mutex mutex;
  std::vector<std::shared_ptr<Job>> jobs;
  unsigned long tickets = 0;
  std::thread thread;
  std::atomic<bool> running{false};
  Clock::time_point tick_began;
};

Scheduler &scheduler() {
  static Scheduler *const one = new Scheduler;
  return *one;
}

thread_local long tick_here = -1;

std::vector<std::shared_ptr<Job>> jobs_now() {
  const std::lock_guard lock(scheduler().mutex);
  auto &jobs = scheduler().jobs;
  jobs.erase(std::remove_if(jobs.begin(), jobs.end(), [](auto &job) { return job->done.load(); }),
             jobs.end());
  return jobs;
}

void call_all() {
  for (const auto &job : jobs_now()) {
    job->calling = true;
    if (!job->done && job->call(job->user) == 0) job->done = true;
    job->calling = false;
  }
}

void loop() {
  Scheduler &all = scheduler();
  for (long tick = 0; all.running; ++tick) {
    if (tick == told().silent_at)
      while (all.running) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    tick_here = tick;
    all.tick_began = Clock::now();
    call_all();
    told().ticks = tick + 1;
    // at most one tick in a period: the hand moves by ticks, and would seem to jump
    if (told().period_ns > 0)
      std::this_thread::sleep_until(all.tick_began + std::chrono::nanoseconds(told().period_ns));
    else
      std::this_thread::yield();
  }
  tick_here = -1;
}

std::shared_ptr<Job> find(unsigned long ticket) {
  const std::lock_guard lock(scheduler().mutex);
  for (const auto &job : scheduler().jobs)
    if (job->ticket == ticket) return job;
  return nullptr;
}

std::shared_ptr<Job> add(unsigned (*call)(void *), void *user, unsigned short priority) {
  const std::lock_guard lock(scheduler().mutex);
  auto job = std::make_shared<Job>();
  job->ticket = ++scheduler().tickets;
  job->call = call;
  job->user = user;
  job->priority = priority;
  auto &jobs = scheduler().jobs;
  const auto lower = [&](const auto &other) { return other->priority < priority; };
  jobs.insert(std::find_if(jobs.begin(), jobs.end(), lower), job);
  return job;
}

void sleep_a_moment() {
  std::this_thread::sleep_for(std::chrono::microseconds(200));
}

}  // namespace

long scheduler_tick() {
  return tick_here;
}

void hang() {
  while (told().hang) sleep_a_moment();
}

}  // namespace hd

using namespace hd;

HDAPI void hdStartScheduler() {
  Scheduler &all = scheduler();
  if (all.running.exchange(true)) {
    const std::lock_guard lock(world().mutex);
    return raise(0x304, world().current);
  }
  told().ticks = 0;
  all.thread = std::thread(loop);
  std::this_thread::sleep_for(std::chrono::milliseconds(told().late_start_ms));
}

HDAPI void hdStopScheduler() {
  hang();
  Scheduler &all = scheduler();
  if (all.running.exchange(false) && all.thread.joinable()) all.thread.join();
}

HDAPI void hdSetSchedulerRate(unsigned long rate) {
  if (rate == 500 || rate == 1000) {
    told().period_ns = long(1000000000 / rate);
    return;
  }
  const std::lock_guard lock(world().mutex);
  raise(0x101, world().current);
}

HDAPI unsigned long hdScheduleAsynchronous(unsigned (*call)(void *), void *user,
                                           unsigned short priority) {
  return add(call, user, priority)->ticket;
}

HDAPI void hdScheduleSynchronous(unsigned (*call)(void *), void *user, unsigned short priority) {
  if (!scheduler().running) {
    while (call(user) != 0) sleep_a_moment();
    return;
  }
  const auto job = add(call, user, priority);
  while (!job->done && scheduler().running) sleep_a_moment();
}

HDAPI void hdUnschedule(unsigned long ticket) {
  hang();
  const auto job = find(ticket);
  if (!job) {
    const std::lock_guard lock(world().mutex);
    return raise(0x101, world().current);
  }
  job->done = true;
  while (job->calling && scheduler_tick() < 0) sleep_a_moment();
}

HDAPI unsigned char hdWaitForCompletion(unsigned long ticket, unsigned code) {
  const auto job = find(ticket);
  while (code == 1 && job && !job->done && scheduler().running) sleep_a_moment();
  return job && !job->done;
}

HDAPI double hdGetSchedulerTimeStamp() {
  return std::chrono::duration<double>(Clock::now() - scheduler().tick_began).count();
}
