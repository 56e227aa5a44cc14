// A settle in slices: works on a copy of the present state, and replaces it at the end.
#pragma once

#include <memory>
#include <vector>

#include "history/history.h"
#include "session/snapshot.h"
#include "solve/settling.h"

namespace mvs::core {

class SettleSlices {
 public:
  // `state`: of `before`, after the moves of the hands, which are `hands`. `workers`: nullable.
  SettleSlices(Backend backend, Workers *workers, SnapshotPtr before, State state,
               std::vector<RecordedEvent> hands, const SolveOptions &how, const Progress &host);
  SettleSlices(const SettleSlices &) = delete;
  SettleSlices &operator=(const SettleSlices &) = delete;

  // Works for `seconds`, and one iteration at least; returns false at the end.
  bool advance(double seconds);
  double share() const { return share_; }  // completed, in [0, 1]
  // After the end: moves the result to `settled`.
  SolveStats finish(State &settled);

  const SnapshotPtr &before() const { return before_; }
  const std::vector<RecordedEvent> &hands() const { return hands_; }
  const SolveOptions &options() const { return how_; }

 private:
  Solver solver_;  // of its own: other calls may use that of the simulator in between
  SnapshotPtr before_;
  State state_;
  std::vector<RecordedEvent> hands_;
  SolveOptions how_;
  double share_ = 0;
  std::unique_ptr<Settling> work_;
};

}  // namespace mvs::core
