// The defects of a driver's samples, each with its remedy for the author of the driver.
#pragma once

#include <string>
#include <vector>

#include "text/console.h"

namespace cli {

struct SampleFault {
  const char *name, *sentence;
};

// Those of a device that was started, in a fixed order; a device without any sample has one too.
std::vector<SampleFault> sample_faults(const mvs_device_state &state);

// Those of the ticks of a test: the fastest motion, m/s, and the time that passed by the samples
// and by the clock of the test, s.
std::vector<SampleFault> trace_faults(double fastest, double sampled_s, double elapsed_s);

// An unarmed device latches only on a fault, or at the end of a recording (MVS_CAUSE_SOFTWARE).
bool is_lost(const mvs_device_state &state);

// Prints faults, and that of a device that is lost, on stderr.
void print_faults(const mvs_device_info &info, const mvs_device_state &state,
                  const std::vector<SampleFault> &faults);

// [{"name": ..., "sentence": ...}, ...]
Json sample_faults_json(const std::vector<SampleFault> &faults);

// One line per fault, after the number of faulty samples; "" without a fault.
std::string sample_faults_text(const std::vector<SampleFault> &faults,
                               const mvs_device_state &state);

}  // namespace cli
