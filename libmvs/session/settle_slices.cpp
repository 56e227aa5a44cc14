// A settle in slices.
#include "session/settle_slices.h"

#include "solve/static/mesh_hierarchy.h"

namespace mvs::core {

SettleSlices::SettleSlices(Backend backend, Workers *workers, SnapshotPtr before, State state,
                           std::vector<RecordedEvent> hands, const SolveOptions &how,
                           const Progress &host)
    : solver_(backend, workers),
      before_(std::move(before)),
      state_(std::move(state)),
      hands_(std::move(hands)),
      how_(how) {
  const auto tell = [this, host](double share, double residual) {
    share_ = share;
    return !host || host(share, residual);
  };
  work_ = begin_settle_with_mesh_hierarchy(solver_, *before_->model, state_, how_, tell);
}

bool SettleSlices::advance(double seconds) {
  const double end = seconds_now() + seconds;
  while (work_->advance()) {
    if (seconds_now() >= end) return true;
  }
  return false;
}

SolveStats SettleSlices::finish(State &settled) {
  const SolveStats stats = work_->finish(state_);
  settled = std::move(state_);
  return stats;
}

}  // namespace mvs::core
