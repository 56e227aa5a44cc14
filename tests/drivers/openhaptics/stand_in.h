// Script and record of the stand-in for libHD.so. The library libHD_watched.so exports
// hd_stand_in() beside HDAPI; libHD.so has only the vendor's symbols, and takes the same script
// from the environment: HD_STAND_IN="unplug_at=700,period_ns=200000".
#pragma once
#include <atomic>

struct HdStandIn {
  static constexpr long kNever = -1;
  static constexpr int kDevices = 2, kKept = 1 << 15;

  // The script: ticks count from 0 at each hdStartScheduler.
  std::atomic<long> period_ns{1000000};  // 0: without pauses
  std::atomic<long> unplug_at{kNever};   // no device answers from this tick on
  std::atomic<long> nan_at{kNever};      // the position of this one tick
  std::atomic<long> silent_at{kNever};   // the scheduler calls no callback from here on
  // an error `fail_code` in this one tick, in the frame of `fail_device`, that names `fail_of`
  std::atomic<long> fail_at{kNever};
  std::atomic<long> fail_code{0}, fail_device{0}, fail_of{0};
  std::atomic<long> init_code{0}, init_times{0};  // hdInitDevice fails so often with this
  std::atomic<long> calibration{0x5000}, style{2};
  std::atomic<long> freedoms_out{3};
  std::atomic<long> temperature{20};  // percent of the motors' largest
  std::atomic<long> parked{0};
  std::atomic<long> buttons{0};
  std::atomic<long> late_start_ms{0};  // from the first tick to the end of hdStartScheduler
  std::atomic<long> hang{0};           // 1: stopping or closing blocks while it is 1

  // The record, of device 0 ("Default Device") and 1 ("Phantom2").
  std::atomic<long> ticks{0};
  std::atomic<long> frames[kDevices] = {};   // in the scheduler
  double forces[kDevices][kKept][6] = {};    // N and mN m in each of them; the last kKept
  std::atomic<long> misuses{0};              // calls that HDAPI forbids, NaN values
  std::atomic<const char *> misuse{""};      // the last one
  std::atomic<long> enabled[kDevices] = {};  // bits of hdEnable: 1 << (capability - 0x4000)
  std::atomic<long> open[kDevices] = {};
};

extern "C" HdStandIn *hd_stand_in();
using hd_stand_in_fn = HdStandIn *(*)();
