// The simulator behind mvs_sim: present snapshot, solver, callbacks of the host.
#pragma once

#include <mvs/sim.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "base/workers.h"
#include "formats/file/journal.h"
#include "session/hand_targets.h"
#include "session/recorded_event.h"
#include "session/settle_slices.h"
#include "session/snapshot.h"
#include "solve/solver.h"

// A call works on copies and replaces the present snapshot at its end: it is a transaction. A time
// step copies nothing: it works in a second state buffer, swaps it with the present state on
// success, and a snapshot is built only on demand.
struct mvs_sim {
  explicit mvs_sim(const mvs_sim_desc &desc_in);

  // Returns the present snapshot, from any thread; throws MVS_E_STATE before a valve is set.
  mvs::core::SnapshotPtr present() const;
  // Returns the present model and state without building a snapshot; for the call at work.
  const mvs::core::ModelState &current() const;
  // Returns the present model, null before a valve is set; for the call at work.
  const mvs::core::Model *model() const { return now_.current.model.get(); }
  // The valve as it was set, shared by all snapshots of its history, and null before the first
  // event; for the call at work.
  std::shared_ptr<const mvs::core::ModelState> history_start() const { return now_.history.start; }
  void replace(mvs::core::SnapshotPtr next);
  mvs::core::Load load() const;
  // Whether this load is the present one, and the history records it as that.
  bool has_recorded(const mvs::core::Load &load) const;
  // Advances the present valve by one time step.
  void step(const mvs::core::SolveOptions &how);
  void prepare_step(const mvs::core::SolveOptions &how);
  // Updates the solver after a change of valve or tools, if time steps are in use, so that the next
  // step does not pay for it.
  void make_ready() { solver.make_ready(*now_.current.model, now_.current.state); }

  // Passes one line to the host's log callback.
  [[gnu::format(printf, 3, 4)]] void log(mvs_log_level level, const char *pattern, ...) const;
  // Returns the host's progress callback; empty if it has no callback.
  mvs::core::Progress progress() const;

  const mvs_sim_desc desc;
  std::unique_ptr<mvs::core::Workers> workers;  // null: the calling thread alone
  mvs::core::Solver solver;
  std::optional<mvs::core::SolveStats> stats;
  mvs::core::Group group;                       // number 0: no group is open
  std::unique_ptr<mvs::core::Journal> journal;  // null: no journal is open
  mvs::core::HandTargets hands;                 // posted from any thread
  // null: no settle in slices is under way; a change of the present snapshot ends it
  std::unique_ptr<mvs::core::SettleSlices> slices;
  // of the histories that files brought
  std::vector<std::weak_ptr<const mvs::core::ModelState>> file_starts;
  std::atomic<bool> at_work{false};
  // Expires with the simulator: a device that is closed later finds no tools to remove.
  const std::shared_ptr<const int> alive = std::make_shared<const int>(0);

 private:
  void must_have_valve() const;
  void begin_step();
  void record_step(const std::vector<mvs::core::RecordedEvent> &moved,
                   const mvs::core::RecordedEvent &step) const;

  mutable std::mutex mutex_;                  // protects the next three
  mutable mvs::core::Snapshot now_;           // null model before a valve is set
  mutable mvs::core::RecordedEvent stepped_;  // pending event, not yet in now_; count 0: no event
  mutable mvs::core::SnapshotPtr present_;    // cached snapshot of now_; null after a step
  mvs::core::State next_;                     // buffer of the next step
};

namespace mvs::core {

// Marks a simulator as busy; throws if a callback or another thread calls it meanwhile.
class AtWork {
 public:
  explicit AtWork(mvs_sim *sim);
  AtWork(const AtWork &) = delete;
  AtWork &operator=(const AtWork &) = delete;
  ~AtWork() { sim_->at_work = false; }

 private:
  mvs_sim *sim_;
};

// Throws MVS_E_STATE with the name of the call if a group is open.
void must_be_no_group(const mvs_sim &sim, const char *call);

// Replaces the valve of a simulator by a snapshot, and logs warnings about it.
void replace_valve(mvs_sim &sim, Snapshot snapshot);

}  // namespace mvs::core
