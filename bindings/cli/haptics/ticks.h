// Statistics of servo ticks: the periods between them and their durations.
#pragma once

#include <array>
#include <vector>

#include "text/console.h"

namespace cli {

class Ticks {
 public:
  explicit Ticks(double rate) : nominal_s_(1 / rate) {}

  // Adds consecutive ticks; `gap`: ticks between these and the previous ones were lost.
  void take(const std::vector<mvs_device_sample> &samples, bool gap);
  size_t count() const { return count_; }
  // s, from the first to the last tick
  double seconds() const { return last_s_ - first_s_; }
  // m/s, largest mean speed of the hand between two ticks
  double fastest() const { return fastest_; }
  // "period_us", "servo_us" (null on a virtual clock) and "histogram".
  Json json() const;
  std::string text() const;

 private:
  std::vector<size_t> histogram() const;

  double nominal_s_;
  std::vector<double> period_s_, servo_s_;
  double first_s_ = 0, last_s_ = 0;
  double fastest_ = 0;
  std::array<double, 3> place_{};
  size_t count_ = 0;
};

}  // namespace cli
