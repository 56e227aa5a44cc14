#include "haptics/sample_faults.h"

#include <cstdio>

#include "haptics/device.h"

namespace cli {
namespace {

struct FaultRow {
  uint32_t bit;
  SampleFault fault;
};

constexpr FaultRow fault_rows[] = {
    {MVS_SAMPLE_FAULT_NUMBER,
     {"number",
      "a position or velocity is not finite, or above 1000 m/s: write finite numbers in m and m/s, "
      "and set MVS_DRIVER_FLAG_VELOCITY only where the velocity is measured"}},
    {MVS_SAMPLE_FAULT_ORIENTATION,
     {"orientation",
      "the orientation is not a unit quaternion: write w x y z of norm 1, which is 1 0 0 0 for a "
      "device with 3 freedoms"}},
    {MVS_SAMPLE_FAULT_FAR,
     {"far",
      "a position is more than 1 m from the centre of the workspace: write metres, not "
      "millimetres, and set mvs_driver_info.frame so that the centre becomes 0"}},
    {MVS_SAMPLE_FAULT_SEQUENCE,
     {"sequence",
      "no new sample for 0.1 s: increase `sequence` with each new sample; if the driver does so, "
      "check the connection of the device"}},
    {MVS_SAMPLE_FAULT_CLOCK,
     {"clock",
      "the time of the samples stands still or goes back: write `time_ns` in ns on the clock of "
      "`now_ns`, never less than before"}}};

constexpr SampleFault no_sample = {
    "no_sample",
    "the device gave no sample: read() has to return one at each call, and run() has to call the "
    "servo for each sample"};

constexpr SampleFault not_calibrated = {
    "calibration",
    "the device is not calibrated, so that forces cannot be switched on: see mvs haptics doctor"};

constexpr SampleFault warm = {
    "warm", "the motors are too warm, so that forces cannot be switched on: let the device cool"};

// m/s; no hand is as fast
constexpr double fastest_hand = 10;
constexpr SampleFault jump = {"jump",
                              "a position jumps, faster than a hand moves: with forces on they "
                              "would be latched off; check the "
                              "units and the connection of the device"};

// s, between the end of a test and its last sample
constexpr double latest_sample = 0.5;
constexpr SampleFault clock_ahead = {"clock_ahead",
                                     "the time of the samples runs ahead of the clock: write "
                                     "`time_ns` in ns on the clock of `now_ns`"};

}  // namespace

std::vector<SampleFault> sample_faults(const mvs_device_state &state) {
  if (state.ticks == 0 && state.phase != MVS_DEVICE_PHASE_LATCHED) return {no_sample};
  std::vector<SampleFault> found;
  for (const FaultRow &row : fault_rows) {
    if (state.sample_faults & row.bit) found.push_back(row.fault);
  }
  const bool has_flags = state.ticks > 0 && state.bad_samples == 0 && !is_lost(state);
  if (has_flags && !(state.flags & MVS_DRIVER_FLAG_CALIBRATED)) found.push_back(not_calibrated);
  if (has_flags && (state.flags & MVS_DRIVER_FLAG_WARM)) found.push_back(warm);
  return found;
}

std::vector<SampleFault> trace_faults(double fastest, double sampled_s, double elapsed_s) {
  std::vector<SampleFault> found;
  if (fastest > fastest_hand) found.push_back(jump);
  if (sampled_s > elapsed_s + latest_sample) found.push_back(clock_ahead);
  return found;
}

bool is_lost(const mvs_device_state &state) {
  return state.phase == MVS_DEVICE_PHASE_LATCHED && state.cause != MVS_CAUSE_SOFTWARE;
}

void print_faults(const mvs_device_info &info, const mvs_device_state &state,
                  const std::vector<SampleFault> &faults) {
  for (const SampleFault &fault : faults) {
    std::fprintf(stderr, "mvs: the driver %s: %s\n", info.driver, fault.sentence);
  }
  if (is_lost(state)) std::fprintf(stderr, "mvs: %s\n", cause_of(state.cause).sentence);
}

Json sample_faults_json(const std::vector<SampleFault> &faults) {
  Json all = Json::array();
  for (const SampleFault &fault : faults) {
    all.push_back({{"name", fault.name}, {"sentence", fault.sentence}});
  }
  return all;
}

std::string sample_faults_text(const std::vector<SampleFault> &faults,
                               const mvs_device_state &state) {
  if (faults.empty()) return "";
  std::string lines;
  if (state.bad_samples > 0)
    lines = text("  %llu of %llu samples are faulty\n",
                 static_cast<unsigned long long>(state.bad_samples),
                 static_cast<unsigned long long>(state.ticks));
  for (const SampleFault &fault : faults) lines += text("  fault: %s\n", fault.sentence);
  return lines;
}

}  // namespace cli
