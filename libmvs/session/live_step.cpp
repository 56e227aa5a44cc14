// One time step without a snapshot, and without allocation once the buffers exist.
#include "history/tool_trajectory.h"
#include "model/finite.h"
#include "session/simulator.h"

using namespace mvs::core;

// Only the call at work changes the current state, so that it reads the state without the lock.
void mvs_sim::step(const SolveOptions &how) {
  must_have_valve();
  begin_step();
  const std::vector<RecordedEvent> moved = hands.take(next_);
  const SolveStats found = solver.step(*now_.current.model, next_, how);
  must_be_finite(next_);
  SnapshotPtr before;  // released outside the lock
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!now_.history.start) now_.history.start = start_of(now_);
    record_step(moved, event_of(RecordedEvent::step, how));
    std::swap(now_.current.state, next_);
    present_.swap(before);
  }
  hands.done(now_.current.state);
  stats = found;
  slices.reset();
}

void mvs_sim::prepare_step(const SolveOptions &how) {
  must_have_valve();
  solver.prepare_step(*now_.current.model, now_.current.state, how);
}

// Copies the current state into the buffers of the state before it (double buffering). If a
// snapshot shares these buffers, the copy-on-write arrays allocate new ones.
void mvs_sim::begin_step() {
  const State &now = now_.current.state;
  CowVector<Vec3> x = std::move(next_.x), v = std::move(next_.v);
  x.edit() = now.x.get();
  v.edit() = now.v.get();
  next_ = now;
  next_.x = std::move(x);
  next_.v = std::move(v);
}

// Merges equal steps and tool trajectories into one pending event. It enters the history when a
// snapshot is taken or another kind of step follows.
void mvs_sim::record_step(const std::vector<RecordedEvent> &moved,
                          const RecordedEvent &step) const {
  RecordedEvent next = moved.empty() ? step : trajectory_event(moved, step);
  if (stepped_.count > 0) append_steps(stepped_, next);
  if (next.count == 0) return;
  if (stepped_.count > 0) now_.history.events = with_event(now_.history.events, stepped_);
  stepped_ = std::move(next);
}
