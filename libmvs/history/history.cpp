// Undo, redo, checkpoints and the record of events.
#include "history/history.h"

#include "base/error.h"
#include "history/tool_trajectory.h"
#include "model/finite.h"

namespace mvs::core {
namespace {

bool in_same_group(const HistoryEntry &a, const HistoryEntry &b) {
  return a.group != 0 && a.group == b.group;
}

Snapshot undone_once(const Snapshot &now) {
  const std::shared_ptr<const HistoryEntry> entry = now.history.past.top();
  Snapshot snapshot{entry->before, now.history};
  snapshot.history.past = now.history.past.popped();
  snapshot.history.future = now.history.future.pushed(entry);
  snapshot.history.events = entry->events;
  return snapshot;
}

Snapshot redone_once(const Snapshot &now) {
  const std::shared_ptr<const HistoryEntry> entry = now.history.future.top();
  Snapshot snapshot{entry->after, now.history};
  snapshot.history.past = now.history.past.pushed(entry);
  snapshot.history.future = now.history.future.popped();
  snapshot.history.events = {};
  return snapshot;
}

bool replaces(const RecordedEvent &event, const RecordedEvent &last) {
  if (event.kind != last.kind) return false;
  if (event.kind == RecordedEvent::load) return true;
  return event.kind == RecordedEvent::tool_move && event.tools[0].id == last.tools[0].id;
}

}  // namespace

std::shared_ptr<const ModelState> start_of(const Snapshot &snapshot) {
  if (snapshot.history.start) return snapshot.history.start;
  return std::make_shared<const ModelState>(snapshot.current);
}

RecordedEvents with_event(const RecordedEvents &events, RecordedEvent event) {
  if (events.empty()) return events.pushed(std::move(event));
  const RecordedEvent &last = events.top();
  if (replaces(event, last)) return events.popped().pushed(std::move(event));
  RecordedEvent longer = last;
  const uint64_t all = event.count;
  append_steps(longer, event);
  RecordedEvents before = event.count < all ? events.popped().pushed(std::move(longer)) : events;
  if (event.count == 0) return before;
  event = with_tools_of(before.top(), std::move(event));
  event.tools.share_with(before.top().tools);
  return before.pushed(std::move(event));
}

bool is_newest_load(const RecordedEvents &events, const Load &load) {
  RecordedEvents older = events;
  for (int k = 0; k < 16 && !older.empty(); ++k, older = older.popped()) {
    const RecordedEvent &event = older.top();
    if (event.kind != RecordedEvent::load) continue;
    return event.pressure == load.pressure && event.boundary_fraction == load.boundary_fraction;
  }
  return false;
}

Snapshot after_event(const Snapshot &now, State state, const RecordedEvent &event) {
  return after_event(now, std::move(state), {}, event);
}

Snapshot after_event(const Snapshot &now, State state, const std::vector<RecordedEvent> &first,
                     const RecordedEvent &event) {
  must_be_finite(state);
  share(state, now.current.state);
  Snapshot snapshot{{now.current.model, std::move(state)}, now.history};
  snapshot.history.start = start_of(now);
  for (const RecordedEvent &before : first) {
    snapshot.history.events = with_event(snapshot.history.events, before);
  }
  snapshot.history.events = with_event(snapshot.history.events, event);
  return snapshot;
}

void apply_event(const Model &model, State &state, const RecordedEvent &event) {
  state.rest_tolerance = 0;
  if (event.kind == RecordedEvent::load) {
    state.load = {event.pressure, event.boundary_fraction};
    return;
  }
  const Tool &tool = event.tools[0];
  if (event.kind == RecordedEvent::tool_add) {
    add_tool(model, state, tool);
  } else if (event.kind == RecordedEvent::tool_move) {
    move_tool(state, tool.id, tool.position, tool.axis);
  } else {
    remove_tool(state, tool.id);
  }
}

Snapshot after_op(const Snapshot &now, const Operation &op, const Group &group, int64_t time_ms) {
  Operated done = perform(now.current, op);
  auto entry = std::make_shared<const HistoryEntry>(
      HistoryEntry{op, std::move(done.title), done.made, group.number, group.name, time_ms,
                   now.history.events, now.current, done.current});
  Snapshot snapshot{std::move(done.current), now.history};
  snapshot.history.start = start_of(now);
  snapshot.history.past = now.history.past.pushed(std::move(entry));
  snapshot.history.future = {};
  snapshot.history.events = {};
  return snapshot;
}

Snapshot undone(const Snapshot &now) {
  MVS_MUST(!now.history.past.empty(), MVS_E_STATE, "undo",
           "there is no operation to undo: the valve is as it was set or loaded");
  const std::shared_ptr<const HistoryEntry> first = now.history.past.top();
  Snapshot snapshot = undone_once(now);
  while (!snapshot.history.past.empty() && in_same_group(*snapshot.history.past.top(), *first)) {
    snapshot = undone_once(snapshot);
  }
  return snapshot;
}

Snapshot redone(const Snapshot &now) {
  MVS_MUST(
      !now.history.future.empty(), MVS_E_STATE, "redo",
      "there is no operation to redo: no operation was undone, or another one was applied since");
  const std::shared_ptr<const HistoryEntry> first = now.history.future.top();
  Snapshot snapshot = redone_once(now);
  while (!snapshot.history.future.empty() &&
         in_same_group(*snapshot.history.future.top(), *first)) {
    snapshot = redone_once(snapshot);
  }
  return snapshot;
}

Snapshot with_checkpoint(const Snapshot &now, const std::string &name) {
  auto list = now.history.checkpoints ? *now.history.checkpoints : std::vector<Checkpoint>();
  std::erase_if(list, [&](const Checkpoint &c) { return c.name == name; });
  list.push_back({name, now.current, now.history.past, now.history.future, now.history.events});
  Snapshot snapshot = now;
  snapshot.history.start = start_of(now);
  snapshot.history.checkpoints = std::make_shared<const std::vector<Checkpoint>>(std::move(list));
  return snapshot;
}

Snapshot at_checkpoint(const Snapshot &now, const std::string &name) {
  if (now.history.checkpoints) {
    for (const Checkpoint &c : *now.history.checkpoints) {
      if (c.name != name) continue;
      Snapshot snapshot{c.at, now.history};
      snapshot.history.past = c.past;
      snapshot.history.future = c.future;
      snapshot.history.events = c.events;
      return snapshot;
    }
  }
  fail(MVS_E_ID, "checkpoint", "there is no checkpoint named \"%.63s\"", name.c_str());
}

}  // namespace mvs::core
