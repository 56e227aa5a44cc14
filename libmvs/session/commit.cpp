// Journal records and the commit of a transaction.
#include "session/commit.h"

#include <chrono>

namespace mvs::core {

int64_t now_ms() {
  using namespace std::chrono;
  return duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
}

void commit(mvs_sim &sim, Snapshot after, const Record &record) {
  SnapshotPtr next = make_snapshot(std::move(after));
  if (sim.journal) sim.journal->append(record(next->value).line());
  sim.replace(std::move(next));
  if (sim.group.number == 0) sim.make_ready();
}

namespace {

const std::vector<Checkpoint> &checkpoints_of(const Snapshot &snapshot) {
  static const std::vector<Checkpoint> no_checkpoints;
  return snapshot.history.checkpoints ? *snapshot.history.checkpoints : no_checkpoints;
}

// The operations that were undone, each after its events, in the order in which they can be redone.
Json undone_steps(const Snapshot &snapshot) {
  Json steps = Json::array();
  const auto entries = snapshot.history.future.items();
  for (size_t k = entries.size(); k-- > 0;) {
    add_events(steps, (*entries[k])->events);
    steps.add(entry_json(**entries[k]));
  }
  return steps;
}

// Adds the steps from the start of the history to a snapshot, and those that were undone there.
void set_steps(Json &json, const Snapshot &snapshot) {
  json.set("steps", plan_steps(snapshot, {}));
  if (!snapshot.history.future.empty()) json.set("undone", undone_steps(snapshot));
}

// Adds all that redo, undo and checkpoints of a snapshot lead to.
void set_history(Json &json, const Snapshot &snapshot) {
  set_steps(json, snapshot);
  Json list = Json::array();
  for (const Checkpoint &c : checkpoints_of(snapshot)) {
    Snapshot there{c.at, snapshot.history};
    there.history.past = c.past;
    there.history.future = c.future;
    there.history.events = c.events;
    Json one = Json::object({{"name", c.name}});
    set_steps(one, there);
    list.add(std::move(one));
  }
  json.set("checkpoints", std::move(list));
}

Json restart_record(const Snapshot &snapshot) {
  Json json = word_record("restart");
  set_history(json, snapshot);
  return json;
}

}  // namespace

void restart_journal(mvs_sim &sim, const Snapshot &restored) {
  if (!sim.journal) return;
  if (hash_text(*start_of(restored)) == hash_text(*start_of(sim.present()->value))) {
    sim.journal->append(restart_record(restored).line());
    return;
  }
  sim.journal.reset();
  sim.log(MVS_LOG_WARNING, "the journal ends: the snapshot restored is of another valve");
}

Json begun_record(const Snapshot &snapshot) {
  Json json;
  json.set("do", "begin");
  json.set("version", plan_version);
  json.set("valve", valve_json(*start_of(snapshot)));
  json.set("present", Json::object({{"hash", hash_text(snapshot.current)}}));
  set_history(json, snapshot);
  return json;
}

Json steps_record(const Snapshot &before, const Snapshot &after) {
  Json json;
  json.set("do", "apply");
  Json steps = Json::array();
  const auto entries = after.history.past.items();
  for (size_t k = before.history.past.size(); k < entries.size(); ++k) {
    add_events(steps, (*entries[k])->events);
    steps.add(entry_json(**entries[k]));
  }
  add_events(steps, after.history.events);
  json.set("steps", std::move(steps));
  return json;
}

Json word_record(const char *word) {
  Json json;
  json.set("do", word);
  return json;
}

Json named_record(const char *word, const std::string &name, const RecordedEvents &events) {
  Json json = word_record(word);
  json.set("name", name);
  Json steps = Json::array();
  add_events(steps, events);
  json.set("steps", std::move(steps));
  return json;
}

}  // namespace mvs::core
