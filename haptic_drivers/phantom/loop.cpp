// run(): schedules tick() in the vendor's scheduler and supervises it; stop() and panic().
#include <pthread.h>
#include <time.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "common/locale.h"
#include "common/sentence.h"
#include "device.h"
#include "words.h"

namespace phantom {
namespace {

constexpr int kPollMs = 2;
// Polls without a tick until the device counts as lost; the scheduler starts slowly.
constexpr int kTimeout = MVS_DRIVER_PATIENCE_MS / kPollMs, kFirstTimeout = 2000 / kPollMs;

void reset(Loop &loop, mvs_driver_servo servo, void *user) {
  loop.servo = servo;
  loop.user = user;
  loop.quiet = loop.strange = 0;
  loop.cause = MVS_CAUSE_NONE;
  loop.enabled = loop.calibrated = loop.warm = loop.saturated = false;
  loop.sequence = 0;
  loop.ticks = 0;
  loop.phase = kWithLibrary;
  loop.ended = false;
  loop.result = MVS_DRIVER_OK;
  loop.code = 0;
  loop.panicked = false;
}

// Hz; 0 keeps the library's rate. All devices support 500 and 1000, some more.
unsigned long rate_of(const mvs_driver_device &device) {
  const std::string chosen = option(device.host, "rate");
  return chosen.empty() ? 0 : std::strtoul(chosen.c_str(), nullptr, 10);
}

int32_t begin_locked(mvs_driver_device &device) {
  Shared &all = shared();
  const driver::DecimalPoint point;
  take_errors(hd());
  const unsigned long rate = rate_of(device);
  if (rate && all.running == 0) hd().set_scheduler_rate(rate);
  if (const unsigned code = take_errors(hd()).code)
    return fail(device.sentence, MVS_DRIVER_E_OPTION,
                driver::sentence("rate=%lu: this device does not run at that: %s", rate,
                                 describe(hd(), code).c_str()));
  // set before the first tick, whose servo may close the device
  device.running = true;
  const unsigned long ticket = hd().schedule(tick, &device, kHighestPriority);
  unsigned code = take_errors(hd()).code;
  if (code == 0 && all.running == 0) {
    hd().start_scheduler();
    code = take_errors(hd()).code;
  }
  if (code) {
    hd().unschedule(ticket);
    device.running = false;
    take_errors(hd());
    return fail(device.sentence, MVS_DRIVER_E_FAULT,
                "OpenHaptics' scheduler does not start: " + describe(hd(), code) +
                    ". Close other programs that use the device, and start again");
  }
  ++all.running;
  return MVS_DRIVER_OK;
}

// Waits until the loop has ended; returns false if the scheduler stopped calling, after which the
// servo is not called again. Counts polls, not seconds, so that a suspended process does not time
// out. Time spent in the servo does not count.
bool wait(Loop &loop) {
  uint64_t seen = 0;
  for (int polls = 0; !loop.ended; ++polls) {
    std::this_thread::sleep_for(std::chrono::milliseconds(kPollMs));
    const uint64_t ticks = loop.ticks;
    if (ticks != seen || loop.phase == kInServo) polls = 0;
    seen = ticks;
    if (polls < (seen ? kTimeout : kFirstTimeout)) continue;
    int expected = kWithLibrary;
    if (loop.phase.compare_exchange_strong(expected, kGivenUp)) return loop.ended;
  }
  return true;
}

int32_t say_end(mvs_driver_device &device) {
  const int32_t result = device.loop.result;
  if (result == MVS_DRIVER_OK) return result;
  const unsigned code = device.loop.code;
  const std::string what = device.info.model + (": " + describe(hd(), code));
  return fail(device.sentence, result,
              result == MVS_DRIVER_E_LOST
                  ? "the device is gone, " + what + ". Check cable and power, then open it again"
                  : "OpenHaptics went wrong in the loop, " + what);
}

void stop_scheduler(unsigned) {
  hd().stop_scheduler();
}

int32_t finish(mvs_driver_device &device, bool answered) {
  const std::lock_guard lock(shared().mutex);
  Shared &all = shared();
  --all.running;
  if (!answered) {
    device.abandoned = true;
    device.quit = true;
    device.loop.result = MVS_DRIVER_E_LOST;
    return fail(device.sentence, MVS_DRIVER_E_LOST,
                driver::sentence("OpenHaptics has not called for %u ms: %s is gone or its driver "
                                 "hangs. Unplug it, plug it in, and open it again",
                                 MVS_DRIVER_PATIENCE_MS, device.info.model));
  }
  if (all.running == 0) {
    if (device.loop.result == MVS_DRIVER_OK)
      hd().stop_scheduler();
    else if (!broken())
      call_with_timeout(stop_scheduler, 0);
  }
  const int32_t result = say_end(device);
  if (!broken()) take_errors(hd());
  return result;
}

}  // namespace

int32_t run(mvs_driver_device *device, mvs_driver_servo servo, void *user) {
  const int32_t result = guarded(device->sentence, [&]() -> int32_t {
    if (!device->started || !servo || device->abandoned)
      return fail(device->sentence, MVS_DRIVER_E_INTERNAL,
                  "run: start() comes first, with a device that is not lost, and a servo");
    if (device->quit) return MVS_DRIVER_OK;
    reset(device->loop, servo, user);
    {
      const std::lock_guard lock(shared().mutex);
      if (const int32_t code = begin_locked(*device)) return code;
    }
    const int32_t code = finish(*device, wait(device->loop));
    device->running = false;
    return code;
  });
  if (device->close_after) close(device);
  return result;
}

int32_t stop(mvs_driver_device *device) {
  device->quit = true;
  return MVS_DRIVER_OK;
}

// HDAPI must not be called from a signal handler that interrupted it. A signal inside the servo, on
// the scheduler's thread, did not interrupt it: the handler writes zero into the open frame.
// Otherwise the scheduler's thread continues and writes zero in its next two ticks.
void panic(mvs_driver_device *device) {
  Loop &loop = device->loop;
  loop.panicked = true;
  if (!device->running) return;
  if (loop.servo_thread == (unsigned long)pthread_self()) {
    const double zero[3] = {};
    hd().set_doubles(kForce, zero);
    if (device->info.freedoms_out == 6) hd().set_doubles(kTorque, zero);
    hd().end_frame(device->handle);
    return;
  }
  const uint64_t seen = loop.ticks;
  const timespec millisecond = {0, 1000000};
  for (int i = 0; i < 20 && loop.ticks < seen + 2 && !loop.ended; ++i)
    nanosleep(&millisecond, nullptr);
}

}  // namespace phantom
