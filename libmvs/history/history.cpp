// Going along a history.
#include "history/history.h"

#include "base/error.h"
#include "history/tool_trajectory.h"
#include "model/finite.h"

namespace mvs::core {
namespace {

bool in_same_group(const Entry &a, const Entry &b) {
  return a.group != 0 && a.group == b.group;
}

Moment undone_once(const Moment &now) {
  const std::shared_ptr<const Entry> entry = now.timeline.past.top();
  Moment moment{entry->before, now.timeline};
  moment.timeline.past = now.timeline.past.popped();
  moment.timeline.future = now.timeline.future.pushed(entry);
  moment.timeline.moves = entry->moves;
  return moment;
}

Moment redone_once(const Moment &now) {
  const std::shared_ptr<const Entry> entry = now.timeline.future.top();
  Moment moment{entry->after, now.timeline};
  moment.timeline.past = now.timeline.past.pushed(entry);
  moment.timeline.future = now.timeline.future.popped();
  moment.timeline.moves = {};
  return moment;
}

bool replaces(const Move &move, const Move &last) {
  if (move.kind != last.kind) return false;
  if (move.kind == Move::load) return true;
  return move.kind == Move::tool_move && move.tool[0].id == last.tool[0].id;
}

}  // namespace

std::shared_ptr<const Picture> start_of(const Moment &moment) {
  if (moment.timeline.start) return moment.timeline.start;
  return std::make_shared<const Picture>(moment.picture);
}

Moves with_move(const Moves &moves, Move move) {
  if (moves.empty()) return moves.pushed(std::move(move));
  const Move &last = moves.top();
  if (replaces(move, last)) return moves.popped().pushed(std::move(move));
  Move longer = last;
  const uint64_t all = move.count;
  take_on(longer, move);
  Moves before = move.count < all ? moves.popped().pushed(std::move(longer)) : moves;
  if (move.count == 0) return before;
  move = widened(before.top(), std::move(move));
  move.tool.share_with(before.top().tool);
  return before.pushed(std::move(move));
}

Moment after_move(const Moment &now, State state, const Move &move) {
  return after_move(now, std::move(state), {}, move);
}

Moment after_move(const Moment &now, State state, const std::vector<Move> &first,
                  const Move &move) {
  must_be_finite(state);
  share(state, now.picture.state);
  Moment moment{{now.picture.model, std::move(state)}, now.timeline};
  moment.timeline.start = start_of(now);
  for (const Move &before : first) {
    moment.timeline.moves = with_move(moment.timeline.moves, before);
  }
  moment.timeline.moves = with_move(moment.timeline.moves, move);
  return moment;
}

void take_move(const Model &model, State &state, const Move &move) {
  if (move.kind == Move::load) {
    state.load = {move.pressure, move.boundary_fraction};
    return;
  }
  const Tool &tool = move.tool[0];
  if (move.kind == Move::tool_add) {
    add_tool(model, state, tool);
  } else if (move.kind == Move::tool_move) {
    move_tool(state, tool.id, tool.position, tool.axis);
  } else {
    remove_tool(state, tool.id);
  }
}

Moment after_op(const Moment &now, const Operation &op, const Group &group, int64_t time_ms) {
  Operated done = perform(now.picture, op);
  auto entry = std::make_shared<const Entry>(Entry{op, std::move(done.title), done.made,
                                                   group.number, group.name, time_ms,
                                                   now.timeline.moves, now.picture, done.picture});
  Moment moment{std::move(done.picture), now.timeline};
  moment.timeline.start = start_of(now);
  moment.timeline.past = now.timeline.past.pushed(std::move(entry));
  moment.timeline.future = {};
  moment.timeline.moves = {};
  return moment;
}

Moment undone(const Moment &now) {
  MVS_MUST(!now.timeline.past.empty(), MVS_E_STATE, "undo",
           "there is no operation to undo: the valve is as it was set or loaded");
  const std::shared_ptr<const Entry> first = now.timeline.past.top();
  Moment moment = undone_once(now);
  while (!moment.timeline.past.empty() && in_same_group(*moment.timeline.past.top(), *first)) {
    moment = undone_once(moment);
  }
  return moment;
}

Moment redone(const Moment &now) {
  MVS_MUST(!now.timeline.future.empty(), MVS_E_STATE, "redo",
           "there is no operation to redo: none was undone, or another one was applied since");
  const std::shared_ptr<const Entry> first = now.timeline.future.top();
  Moment moment = redone_once(now);
  while (!moment.timeline.future.empty() && in_same_group(*moment.timeline.future.top(), *first)) {
    moment = redone_once(moment);
  }
  return moment;
}

Moment with_checkpoint(const Moment &now, const std::string &name) {
  auto list = now.timeline.checkpoints ? *now.timeline.checkpoints : std::vector<Checkpoint>();
  std::erase_if(list, [&](const Checkpoint &c) { return c.name == name; });
  list.push_back({name, now.picture, now.timeline.past, now.timeline.future, now.timeline.moves});
  Moment moment = now;
  moment.timeline.start = start_of(now);
  moment.timeline.checkpoints = std::make_shared<const std::vector<Checkpoint>>(std::move(list));
  return moment;
}

Moment at_checkpoint(const Moment &now, const std::string &name) {
  if (now.timeline.checkpoints) {
    for (const Checkpoint &c : *now.timeline.checkpoints) {
      if (c.name != name) continue;
      Moment moment{c.at, now.timeline};
      moment.timeline.past = c.past;
      moment.timeline.future = c.future;
      moment.timeline.moves = c.moves;
      return moment;
    }
  }
  fail(MVS_E_ID, "checkpoint", "there is no checkpoint named \"%.63s\"", name.c_str());
}

}  // namespace mvs::core
