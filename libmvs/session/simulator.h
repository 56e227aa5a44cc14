// The simulator behind mvs_sim: its present moment, a solver, the host's callbacks.
#pragma once

#include <mvs/sim.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "formats/file/journal.h"
#include "session/hand_targets.h"
#include "session/recorded_event.h"
#include "session/snapshot.h"
#include "solve/solver.h"

// A call works on copies and ends by replacing the present moment: that is the transaction. Only a
// step takes no copy: it works in memory of its own, changes places with the present state when all
// is well, and leaves it to who asks for a snapshot to make one.
struct mvs_sim {
  explicit mvs_sim(const mvs_sim_desc &desc_in) : desc(desc_in), solver(desc_in.backend) {}

  // The present snapshot; throws MVS_E_STATE before there is a valve. From any thread.
  mvs::core::SnapshotPtr present() const;
  // The same for the call at work, without making one.
  const mvs::core::ModelState &current() const;
  void replace(mvs::core::SnapshotPtr next);
  mvs::core::Load load() const;
  // One step in time of the present valve.
  void step(const mvs::core::SolveOptions &how);
  // What the next step would do because of another valve or other tools, if steps are taken at all:
  // work of the call that changed them.
  void make_ready() { solver.make_ready(*now_.current.model, now_.current.state); }

  // One line to the host.
  [[gnu::format(printf, 3, 4)]] void log(mvs_log_level level, const char *pattern, ...) const;
  // The host's progress callback; empty where there is none.
  mvs::core::Progress progress() const;

  const mvs_sim_desc desc;
  mvs::core::Solver solver;
  std::optional<mvs::core::SolveStats> stats;
  mvs::core::Group group;                       // number 0: none is open
  std::unique_ptr<mvs::core::Journal> journal;  // null: none
  mvs::core::HandTargets hands;                 // from any thread
  std::atomic<bool> at_work{false};

 private:
  void must_have_valve() const;
  void begin_step();
  void record_step(const std::vector<mvs::core::RecordedEvent> &moved,
                   const mvs::core::RecordedEvent &step) const;

  mutable std::mutex mutex_;                  // of the next three
  mutable mvs::core::Snapshot now_;           // no model: no valve yet
  mutable mvs::core::RecordedEvent stepped_;  // steps that the moves of now_ lack; of count 0: none
  mutable mvs::core::SnapshotPtr present_;    // of now_; null: nobody has asked since the last step
  mvs::core::State next_;                     // where a step works, in memory of the state before
};

namespace mvs::core {

// Marks a simulator as at work; a second call meanwhile, from a callback or another thread, throws.
class AtWork {
 public:
  explicit AtWork(mvs_sim *sim);
  AtWork(const AtWork &) = delete;
  AtWork &operator=(const AtWork &) = delete;
  ~AtWork() { sim_->at_work = false; }

 private:
  mvs_sim *sim_;
};

// Throws MVS_E_STATE in the name of a call while a group is open.
void must_be_no_group(const mvs_sim &sim, const char *call);

// Makes a valve with its state and history the present of a simulator.
void replace_valve(mvs_sim &sim, Snapshot snapshot);

}  // namespace mvs::core
