// A settle that advances in slices of one iteration, so that its caller can do other work between
// two of them. What it returns does not depend on the slices.
#pragma once

#include "solve/solver.h"

namespace mvs::core {

class Settling {
 public:
  virtual ~Settling() = default;
  // Does one iteration of Newton's method or one step in time; false, without work, at the end.
  virtual bool advance() = 0;
  // To be called once, after the end: moves the result to `state`, which holds the state that the
  // settle began with.
  virtual SolveStats finish(State &state) = 0;
  // Before the first advance(): whether more nodes are far from rest than a local subproblem may
  // have. Only Newton's method looks.
  virtual bool begins_far_from_rest() const { return false; }
  // Before the first advance(): the largest force on a free node, N. Only Newton's method looks.
  virtual double largest_first_force() const { return 0; }
};

// Advances to the end.
inline SolveStats run(Settling &settling, State &state) {
  while (settling.advance()) {
  }
  return settling.finish(state);
}

// Adds the time between its construction and destruction to a sum, s.
class AddedTime {
 public:
  explicit AddedTime(double &sum) : sum_(&sum), start_(seconds_now()) {}
  AddedTime(const AddedTime &) = delete;
  AddedTime &operator=(const AddedTime &) = delete;
  ~AddedTime() { *sum_ += seconds_now() - start_; }

 private:
  double *sum_;
  double start_;
};

}  // namespace mvs::core
