// Replay of the steps of a plan or a journal on a snapshot, to the same bits on the same valve.
#pragma once

#include <map>
#include <set>

#include "formats/plan/plan.h"
#include "session/simulator.h"

namespace mvs::core {

// Executes one event and returns the snapshot after it. If it is empty, Replay skips events.
using RunEvent = std::function<Snapshot(const Snapshot &, const RecordedEvent &)>;

class Replay {
 public:
  // With `exact`, a site is the recorded node or triangle and a grasp holds the recorded node,
  // otherwise those at its anatomical place.
  Replay(Snapshot start, bool exact, RunEvent run_event)
      : now(std::move(start)), exact_(exact), run_event_(std::move(run_event)) {}
  // Starts at another snapshot with the settings of another replay.
  Replay(Snapshot start, const Replay &like)
      : now(std::move(start)), exact_(like.exact_), run_event_(like.run_event_) {}

  // Executes steps; throws with the number of the step that failed.
  void run(const std::vector<PlanStep> &steps);

  Snapshot now;

 private:
  void operate(const PlanStep &step);
  void execute(RecordedEvent event, const Json &place);
  void note_tools(const RecordedEvent &event);

  bool exact_;
  RunEvent run_event_;
  std::map<Id, Id> tools_;  // recorded tool id -> id in this simulator
  std::set<Id> added_;      // recorded ids of tools, where events are skipped
  std::string group_;       // of the last operation
  uint64_t group_id_ = 0, number_ = 0;
};

// Checks what does not depend on a valve: keys, types and choices of the operations. Throws with
// the number of the step; returns the number of operations.
uint32_t check_steps(const std::vector<PlanStep> &steps);

// Executes events with the solver of a simulator.
RunEvent event_runner(mvs_sim &sim);

// The measures that a plan stores before and after an operation.
Json plan_measures(const ModelState &current);

}  // namespace mvs::core
