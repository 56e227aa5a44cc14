// The hand and the stylus in it: what moves.
#pragma once

#include <cstdint>

#include "settings.h"

namespace hand {

class Body {
 public:
  Body(const Oscillator &oscillator, const Script &script, const driver::Vector &from);

  const driver::Vector &position() const { return position_; }
  const driver::Vector &velocity() const { return velocity_; }

  // For `length` s from `begin`, s since the script began, under a constant force, N. Before the
  // script begins (a negative time) the arm waits where it will begin.
  void move(double begin, double length, const driver::Vector &force);

 private:
  // Where the arm's end is, m and m/s: beside `middle`, which rests.
  struct Lead {
    driver::Vector middle = {}, offset = {}, speed = {};
  };
  Lead lead(double time) const;
  void piece(double begin, double length, const driver::Vector &force);

  Oscillator oscillator_;
  const Script &script_;
  driver::Vector position_, velocity_ = {};
  double length_ = -1;  // s, of the interval that step_ is for
  Step step_ = {};
};

}  // namespace hand
