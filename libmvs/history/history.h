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
struct Move {
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
  SharedVector<Tool> tool;
  SharedVector<Vec3> way;       // of lead, in rows: where the hands of all of them are,
  SharedVector<uint32_t> pace;  // and how many steps follow

  bool operator==(const Move &) const = default;
};
using Moves = Stack<Move>;

// With one more move; equal steps are counted together, steps that hands lead become one run, and a
// load or a hand that moves on before anything has followed it is replaced.
Moves with_move(const Moves &moves, Move move);

// One operation that was applied.
struct Entry {
  Operation op;
  std::string title;  // for a menu
  Id made = 0;
  uint64_t group = 0;      // 0: none
  std::string group_name;  // "" for none
  int64_t time_ms = 0;     // when, since 1970 UTC
  Moves moves;             // since the operation before it
  Picture before, after;
};
using Entries = Stack<std::shared_ptr<const Entry>>;

// A place to come back to.
struct Checkpoint {
  std::string name;
  Picture at;
  Entries past, future;
  Moves moves;
};

struct Timeline {
  std::shared_ptr<const Picture> start;  // the valve as it was set; null: it is this picture
  Entries past;                          // the last operation on top
  Entries future;                        // undone; the next to be redone on top
  Moves moves;                           // since the last operation
  std::shared_ptr<const std::vector<Checkpoint>> checkpoints;  // null: none
  uint64_t next_group = 1;
};

// A picture with the history up to it.
struct Moment {
  Picture picture;
  Timeline timeline;
};

// The valve as it was set, where the history begins.
std::shared_ptr<const Picture> start_of(const Moment &moment);

// The moment after a move, which led to `state`; throws MVS_E_DIVERGED where a position is no
// number. What the state has in common with the one before is shared.
Moment after_move(const Moment &now, State state, const Move &move);
// The same where other moves came first.
Moment after_move(const Moment &now, State state, const std::vector<Move> &first, const Move &move);

// What a load or a move of a tool does to a state; throws where it cannot be done.
void take_move(const Model &model, State &state, const Move &move);

// These give the moment after; they throw MVS_E_STATE or MVS_E_ID where there is nothing to go to.
struct Group {
  uint64_t number = 0;
  std::string name;
};
Moment after_op(const Moment &now, const Operation &op, const Group &group, int64_t time_ms);
Moment undone(const Moment &now);
Moment redone(const Moment &now);
Moment with_checkpoint(const Moment &now, const std::string &name);
Moment at_checkpoint(const Moment &now, const std::string &name);

}  // namespace mvs::core
