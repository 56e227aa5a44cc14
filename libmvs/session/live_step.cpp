// One step in time, without a snapshot and, once the memory is there, without allocation.
#include "history/tool_trajectory.h"
#include "model/finite.h"
#include "session/simulator.h"

using namespace mvs::core;

// The call at work is the only one that changes the picture, so it reads it without a lock.
void mvs_sim::step(const SolveOptions &how) {
  must_have_valve();
  begin_step();
  const std::vector<RecordedEvent> moved = hands.take(next_);
  const SolveStats found = solver.step(*now_.current.model, next_, how);
  must_be_finite(next_);
  SnapshotPtr before;  // let go of outside the lock
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!now_.history.start) now_.history.start = start_of(now_);
    record_step(moved, move_of(RecordedEvent::step, how));
    std::swap(now_.current.state, next_);
    present_.swap(before);
  }
  hands.done(now_.current.state);
  stats = found;
}

// A copy of the present state in the memory of the one before it. Who holds a snapshot of that
// keeps its memory, and there will be new.
void mvs_sim::begin_step() {
  const State &now = now_.current.state;
  CowVector<Vec3> x = std::move(next_.x), v = std::move(next_.v);
  x.edit() = now.x.get();
  v.edit() = now.v.get();
  next_ = now;
  next_.x = std::move(x);
  next_.v = std::move(v);
}

// Steps are counted, those that hands lead put into one run; they go into the history when somebody
// looks or others follow.
void mvs_sim::record_step(const std::vector<RecordedEvent> &moved,
                          const RecordedEvent &step) const {
  RecordedEvent next = moved.empty() ? step : lead_of(moved, step);
  if (stepped_.count > 0) take_on(stepped_, next);
  if (next.count == 0) return;
  if (stepped_.count > 0) now_.history.moves = with_move(now_.history.moves, stepped_);
  stepped_ = std::move(next);
}
