// Script and record of the stand-in for libdrd.so. The library libdrd_watched.so exports
// dhd_stand_in() beside DHD and DRD; libdrd.so.3 takes the same script from the environment:
// DHD_STAND_IN="type=104,unplug_at=700".
#pragma once
#include <atomic>

struct DhdStandIn {
  static constexpr long kNever = -1;
  static constexpr int kDevices = 2, kKept = 1 << 14;

  // The script. A device's ticks count the reads of its position, from 0 when opened.
  std::atomic<long> count{1};  // devices on the bus
  std::atomic<long> type{33};  // omega.3; 104: sigma.7
  std::atomic<long> left_handed{0};
  std::atomic<long> unplug_at{kNever};             // does not answer from this tick on
  std::atomic<long> deaf_at{kNever}, deaf_for{0};  // does not answer for so many ticks
  std::atomic<long> nan_at{kNever};
  std::atomic<long> guard_at{kNever};      // the time guard returns the previous sample, once
  std::atomic<long> force_off_at{kNever};  // the device takes its forces off, for `cause`
  std::atomic<long> cause{0};
  std::atomic<long> slow{0};            // ticks until forces that are enabled are on
  std::atomic<long> largest_mn{12000};  // mN; more saturates the motors
  std::atomic<long> reset{0};           // it has to be calibrated
  std::atomic<long> supported{1};       // by DRD
  std::atomic<long> stuck{0};           // drdAutoInit fails
  std::atomic<long> open_error{0};
  std::atomic<long> buttons{0};

  // The record.
  std::atomic<long> ticks[kDevices] = {};
  std::atomic<long> writes[kDevices] = {};
  double forces[kDevices][kKept][7] = {};  // N, N m, N; zero while off; the last kKept
  std::atomic<long> on[kDevices] = {}, enables[kDevices] = {}, stops[kDevices] = {};
  std::atomic<long> max_force_mn[kDevices] = {};
  std::atomic<long> moved{0};   // drdAutoInit
  std::atomic<long> unsafe{0};  // safety functions called, NaN values
  std::atomic<long> unsimulated{0};
};

extern "C" DhdStandIn *dhd_stand_in();
using dhd_stand_in_fn = DhdStandIn *(*)();
