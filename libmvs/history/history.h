// Linear undo history with checkpoints: the operations applied to a valve, the operations undone,
// and the events between them. Snapshots are immutable and share their history structurally
// (PersistentList), so that an undo level costs only the data that its operation changed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "history/persistent_list.h"
#include "model/model.h"
#include "surgery/perform.h"

namespace mvs::core {

// A change of the state between two operations, recorded so that a plan replays to the same bits.
struct RecordedEvent {
  enum Kind : uint32_t {
    load = 1,
    settle = 2,
    step = 3,
    tool_add = 4,
    tool_move = 5,
    tool_remove = 6,
    tool_trajectory = 7  // time steps, with tools moved before each (history/tool_trajectory.h)
  };
  static constexpr uint64_t most_count = uint64_t{1} << 40;
  Kind kind = load;
  SolverKind solver = SolverKind::unset;  // of settle and step, as the caller gave it
  uint32_t max_iterations = 0;            // of settle, as the caller gave it
  uint64_t count = 1;   // time steps of a step event (at most most_count) or of a trajectory
  uint32_t budget = 0;  // of step, as the caller gave it
  double pressure = 0, boundary_fraction = 0;  // of load: Pa, 0 to 1
  double residual = 0, dt = 0, damping = 0;    // N, s, 1/s
  // tool_add: the new tool; tool_move: its id and hand; tool_remove: its id; tool_trajectory: id
  // and kind of each tool.
  CowVector<Tool> tools;
  CowVector<Vec3> points;             // of a trajectory: rows with the points of each tool
  CowVector<uint32_t> steps_per_row;  // of a trajectory: time steps after each row, at least 1

  bool operator==(const RecordedEvent &) const = default;
};
using RecordedEvents = PersistentList<RecordedEvent>;

// Appends an event. Equal steps are counted together, trajectories are joined into runs, and a load
// or tool_move directly after one of the same kind replaces it.
RecordedEvents with_event(const RecordedEvents &events, RecordedEvent event);

// Whether the newest load among the last 16 events is this one: to record it again would lengthen
// the history for nothing. No older event is searched, so that a load before each step stays fast.
bool is_newest_load(const RecordedEvents &events, const Load &load);

// An applied operation.
struct HistoryEntry {
  Operation op;
  std::string title;  // for a menu
  Id made = 0;
  uint64_t group = 0;      // 0: no group
  std::string group_name;  // "" without a group
  int64_t time_ms = 0;     // ms since 1970 UTC
  RecordedEvents events;   // since the operation before it
  ModelState before, after;
};
using HistoryEntries = PersistentList<std::shared_ptr<const HistoryEntry>>;

// A named snapshot of the history.
struct Checkpoint {
  std::string name;
  ModelState at;
  HistoryEntries past, future;
  RecordedEvents events;
};

struct History {
  std::shared_ptr<const ModelState> start;  // the valve as it was set; null: the current one
  HistoryEntries past;                      // applied, the last one on top
  HistoryEntries future;                    // undone, the next one to redo on top
  RecordedEvents events;                    // since the last operation
  std::shared_ptr<const std::vector<Checkpoint>> checkpoints;  // null: no checkpoints
  uint64_t next_group = 1;
};

// A model and state with the history that led to them.
struct Snapshot {
  ModelState current;
  History history;
};

// Returns the valve as it was set, where the history begins.
std::shared_ptr<const ModelState> start_of(const Snapshot &snapshot);

// Returns the snapshot after an event that led to `state`; arrays equal to those of `now` are
// shared. Throws MVS_E_DIVERGED if a position is not finite.
Snapshot after_event(const Snapshot &now, State state, const RecordedEvent &event);
// The same after the events `first` and then `event`.
Snapshot after_event(const Snapshot &now, State state, const std::vector<RecordedEvent> &first,
                     const RecordedEvent &event);

// Applies a load or tool event to a state; throws if the tool operation is not possible.
void apply_event(const Model &model, State &state, const RecordedEvent &event);

// The functions below return the next snapshot. They throw MVS_E_STATE or MVS_E_ID if there is no
// operation or checkpoint to go to.
struct Group {
  uint64_t number = 0;
  std::string name;
};
Snapshot after_op(const Snapshot &now, const Operation &op, const Group &group, int64_t time_ms);
Snapshot undone(const Snapshot &now);
Snapshot redone(const Snapshot &now);
Snapshot with_checkpoint(const Snapshot &now, const std::string &name);
Snapshot at_checkpoint(const Snapshot &now, const std::string &name);

}  // namespace mvs::core
