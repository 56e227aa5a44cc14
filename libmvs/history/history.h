// The history of a valve: what was done to it, what was undone, the checkpoints.
//
// It is immutable and shared like models and states are: each snapshot has the history up to it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "history/persistent_list.h"
#include "model/model.h"
#include "surgery/perform.h"

namespace mvs::core {

// What changes a state between two operations, so that a plan can be replayed to the same bits.
struct RecordedEvent {
  enum Kind : uint32_t {
    load = 1,
    settle = 2,
    step = 3,
    tool_add = 4,
    tool_move = 5,
    tool_remove = 6,
    lead = 7  // steps, before each of which hands move (surgery/lead.h)
  };
  static constexpr uint64_t most_count = uint64_t{1} << 40;
  Kind kind = load;
  uint32_t solver = 0, max_iterations = 0;  // of settle and step, as the caller gave them
  uint64_t count = 1;   // of step: how many of the same in a row, at most most_count; of lead: all
  uint32_t budget = 0;  // of step, as the caller gave it
  double pressure = 0, boundary_fraction = 0;  // of load: Pa, 0 to 1
  double residual = 0, dt = 0, damping = 0;    // N, s, 1/s
  // One, of what is done with it: as added; its hand; its id. Of lead: all that are led, by id and
  // kind.
  CowVector<Tool> tool;
  CowVector<Vec3> way;       // of lead, in rows: where the hands of all of them are,
  CowVector<uint32_t> pace;  // and how many steps follow

  bool operator==(const RecordedEvent &) const = default;
};
using RecordedEvents = PersistentList<RecordedEvent>;

// With one more move; equal steps are counted together, steps that hands lead become one run, and a
// load or a hand that moves on before anything has followed it is replaced.
RecordedEvents with_move(const RecordedEvents &moves, RecordedEvent move);

// One operation that was applied.
struct HistoryEntry {
  Operation op;
  std::string title;  // for a menu
  Id made = 0;
  uint64_t group = 0;      // 0: none
  std::string group_name;  // "" for none
  int64_t time_ms = 0;     // when, since 1970 UTC
  RecordedEvents moves;    // since the operation before it
  ModelState before, after;
};
using HistoryEntries = PersistentList<std::shared_ptr<const HistoryEntry>>;

// A place to come back to.
struct Checkpoint {
  std::string name;
  ModelState at;
  HistoryEntries past, future;
  RecordedEvents moves;
};

struct History {
  std::shared_ptr<const ModelState> start;  // the valve as it was set; null: it is this picture
  HistoryEntries past;                      // the last operation on top
  HistoryEntries future;                    // undone; the next to be redone on top
  RecordedEvents moves;                     // since the last operation
  std::shared_ptr<const std::vector<Checkpoint>> checkpoints;  // null: none
  uint64_t next_group = 1;
};

// A picture with the history up to it.
struct Snapshot {
  ModelState current;
  History history;
};

// The valve as it was set, where the history begins.
std::shared_ptr<const ModelState> start_of(const Snapshot &snapshot);

// The moment after a move, which led to `state`; throws MVS_E_DIVERGED where a position is no
// number. What the state has in common with the one before is shared.
Snapshot after_move(const Snapshot &now, State state, const RecordedEvent &move);
// The same where other moves came first.
Snapshot after_move(const Snapshot &now, State state, const std::vector<RecordedEvent> &first,
                    const RecordedEvent &move);

// What a load or a move of a tool does to a state; throws where it cannot be done.
void take_move(const Model &model, State &state, const RecordedEvent &move);

// These give the moment after; they throw MVS_E_STATE or MVS_E_ID where there is nothing to go to.
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
