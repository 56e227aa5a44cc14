// The servo thread: runs on the device's own clock, or polls the device at its rate.
#include <pthread.h>
#include <time.h>

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <utility>

#include "base/utf8.h"
#include "haptics/device_core.h"

namespace mvs::core {
namespace {

constexpr int realtime_priority = 60;  // of SCHED_FIFO, below the priorities of kernel threads

// Fails without the right to it (RLIMIT_RTPRIO); the thread then runs at normal priority.
bool become_realtime() {
  sched_param wanted = {};
  wanted.sched_priority = realtime_priority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted) == 0;
}

void sleep_until(uint64_t ns) {
  const timespec when = {static_cast<time_t>(ns / 1000000000), static_cast<long>(ns % 1000000000)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &when, nullptr) == EINTR) {
  }
}

Cause cause_of(int32_t code) {
  switch (code) {
    case MVS_DRIVER_E_END:
      return Cause::software;
    case MVS_DRIVER_E_FAULT:
      return Cause::thermal;
    case MVS_DRIVER_E_CALIBRATION:
      return Cause::calibration;
    default:
      return Cause::unplugged;
  }
}

}  // namespace

uint64_t clock_ns() {
  timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<uint64_t>(now.tv_sec) * 1000000000 + static_cast<uint64_t>(now.tv_nsec);
}

void Device::Core::serve() {
  const mvs_driver_api &api = plugin->api();
  const bool own_clock = !is_polled();
  realtime = own_clock || become_realtime() ? 1 : 0;
  const int32_t code = own_clock ? api.run(handle, &serve_sample, this) : poll_until_stopped();
  if (code < 0 || !stopping) lose(code, "the driver left its loop without being asked to");
  const std::lock_guard<std::mutex> lock(mutex);
  running = false;
  ended.notify_all();
}

// Stores the driver's own error message if it failed, otherwise `otherwise`. The motors of a device
// that is not read any more would keep their last force: they are switched off here, on the thread
// of the call that failed.
void Device::Core::lose(int32_t code, const char *otherwise) {
  const mvs_driver_api &api = plugin->api();
  const char *const why = code < 0 ? api.error(handle) : nullptr;
  char sentence[sizeof lost];  // the driver's text is valid until its next call
  copy_text(sentence, why && *why ? why : otherwise);
  write_zero();
  api.stop(handle);
  servo->lose(cause_of(code));
  const std::lock_guard<std::mutex> lock(mutex);
  std::copy(std::begin(sentence), std::end(sentence), lost);
}

// A device with a loop of its own has no other call that writes while the loop runs.
int32_t Device::Core::write_zero() {
  const mvs_driver_api &api = plugin->api();
  if (!is_polled()) return MVS_DRIVER_OK;
  mvs_driver_force zero = {};
  zero.struct_size = sizeof zero;
  return api.write(handle, &zero);
}

bool Device::Core::is_polled() const {
  return clock == DeviceClock::virtual_time || !plugin->api().run;
}

bool Device::Core::is_running() {
  const std::lock_guard<std::mutex> lock(mutex);
  return running;
}

void Device::Core::prepare_close() {
  close_call = plugin->prepare(nullptr, [self = shared_from_this()](const mvs_driver_api &api) {
    api.close(self->handle);
    return MVS_DRIVER_OK;
  });
}

void Device::Core::close() noexcept {
  plugin->run(std::exchange(close_call, {}));
}

int32_t Device::Core::serve_sample(void *core, const mvs_driver_state *state,
                                   mvs_driver_force *force) {
  Core &self = *static_cast<Core *>(core);
  if (self.stopping || !state || !force) {
    if (force) {
      const uint32_t size = force->struct_size;
      *force = {};
      force->struct_size = size;
    }
    return MVS_DRIVER_STOP;
  }
  self.tick(*state, *force);
  return MVS_DRIVER_OK;
}

// A late tick is skipped, not repeated: two forces in quick succession do not help.
int32_t Device::Core::poll_until_stopped() {
  const auto period = static_cast<uint64_t>(1e9 / traits.info.rate);
  uint64_t next = clock_ns();
  while (!stopping) {
    if (const int32_t code = exchange(clock_ns()); code < 0) return code;
    next = std::max(next + period, clock_ns());
    sleep_until(next);
  }
  return write_zero();
}

// Reads one sample, computes and writes one force.
int32_t Device::Core::exchange(uint64_t now) {
  const mvs_driver_api &api = plugin->api();
  mvs_driver_state state = {};
  state.struct_size = sizeof state;
  if (const int32_t code = api.read(handle, now, &state); code < 0) return code;
  mvs_driver_force force = {};
  force.struct_size = sizeof force;
  tick(state, force);
  return api.write(handle, &force);
}

void Device::Core::poll(uint64_t now) {
  const int32_t code = exchange(now);
  if (code < 0) lose(code, "the driver does not say why");
}

// On a virtual clock the duration of a tick is not measured.
void Device::Core::tick(const mvs_driver_state &state, mvs_driver_force &force) {
  if (clock == DeviceClock::virtual_time) return servo->tick(state, force);
  const uint64_t begin = clock_ns();
  last_tick_ns.store(static_cast<int64_t>(begin), std::memory_order_relaxed);
  servo->tick(state, force);
  servo->took(1e-9 * static_cast<double>(clock_ns() - begin));
}

}  // namespace mvs::core
