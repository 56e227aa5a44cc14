// The ticks of a servo: how regular they come, and how long it takes for one.
#pragma once

#include <array>
#include <vector>

#include "console.h"

namespace cli {

class Ticks {
 public:
  explicit Ticks(double rate) : nominal_s_(1 / rate) {}

  // Ticks one after another; `gap`: some between these and the ones before were not seen.
  void take(const std::vector<mvs_device_sample> &samples, bool gap);
  size_t count() const { return count_; }
  // s, from the first to the last one
  double seconds() const { return last_s_ - first_s_; }
  // "period_us", "servo_us" (null where no clock ran) and "histogram".
  Json json() const;
  std::string told() const;

 private:
  std::vector<size_t> histogram() const;

  double nominal_s_;
  std::vector<double> period_s_, servo_s_;
  double first_s_ = 0, last_s_ = 0;
  size_t count_ = 0;
};

}  // namespace cli
