// Motion of the hand with the device in it.
#pragma once

#include <cstdint>

#include "settings.h"

namespace hand {

class Body {
 public:
  Body(const Oscillator &oscillator, const Script &script, const driver::Vector &from);

  const driver::Vector &position() const { return position_; }
  const driver::Vector &velocity() const { return velocity_; }

  // Advances by `length` s from `begin`, s after the start of the script, under a constant force,
  // N. Before the script (negative time) the arm rests at its first position.
  void move(double begin, double length, const driver::Vector &force);

 private:
  // The end of the arm: offset, m, and speed, m/s, relative to the fixed point `middle`.
  struct ArmEnd {
    driver::Vector middle = {}, offset = {}, speed = {};
  };
  ArmEnd arm_end(double time) const;
  void advance(double begin, double length, const driver::Vector &force);

  Oscillator oscillator_;
  const Script &script_;
  driver::Vector position_, velocity_ = {};
  double length_ = -1;  // s, interval of step_
  Step step_ = {};
};

}  // namespace hand
