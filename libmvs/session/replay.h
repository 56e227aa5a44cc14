// Replaying steps of a plan or a journal.
#pragma once

#include <map>

#include "formats/plan/plan.h"
#include "session/simulator.h"

namespace mvs::core {

// Takes one move; empty: moves are left out.
using TakeMove = std::function<Snapshot(const Snapshot &, const RecordedEvent &)>;

class Replay {
 public:
  // In `exact` replay sites are the nodes and triangles that they were.
  Replay(Snapshot start, bool exact, TakeMove take)
      : now(std::move(start)), exact_(exact), take_(std::move(take)) {}
  // From another moment in the way of another one.
  Replay(Snapshot start, const Replay &like)
      : now(std::move(start)), exact_(like.exact_), take_(like.take_) {}

  // Goes on by these steps; throws with the number of the one that cannot be done.
  void go(const std::vector<PlanStep> &steps);

  Snapshot now;

 private:
  void operate(const PlanStep &step);
  void move(RecordedEvent step);

  bool exact_;
  TakeMove take_;
  std::map<Id, Id> tools_;  // what the tools that the plan added are called here
  std::string group_;       // of the last operation
  uint64_t group_id_ = 0, number_ = 0;
};

// The moves of a simulator, by its own solver.
TakeMove moves_of(mvs_sim &sim);

// What measures of a picture a plan tells.
Json plan_measures(const ModelState &current);

}  // namespace mvs::core
