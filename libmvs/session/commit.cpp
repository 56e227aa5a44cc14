#include "session/commit.h"

#include <chrono>

namespace mvs::core {

int64_t now_ms() {
  using namespace std::chrono;
  return duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
}

void commit(mvs_sim &sim, Moment after, const Record &record) {
  SnapshotPtr next = make_snapshot(std::move(after));
  if (sim.journal) sim.journal->append(record(next->moment).line());
  sim.replace(std::move(next));
}

namespace {

const std::vector<Checkpoint> &checkpoints_of(const Moment &moment) {
  static const std::vector<Checkpoint> none_there;
  return moment.timeline.checkpoints ? *moment.timeline.checkpoints : none_there;
}

Json restart_record(const Moment &moment) {
  Json json = word_record("restart");
  put_steps(json, plan_steps(moment, {}));
  Json list = Json::array();
  for (const Checkpoint &c : checkpoints_of(moment)) {
    Moment there{c.at, moment.timeline};
    there.timeline.past = c.past;
    there.timeline.moves = c.moves;
    Json one = Json::object({{"name", c.name}});
    put_steps(one, plan_steps(there, {}));
    list.add(std::move(one));
  }
  json.set("checkpoints", std::move(list));
  return json;
}

}  // namespace

void restart_journal(mvs_sim &sim, const Moment &restored) {
  if (!sim.journal) return;
  if (hash_text(*start_of(restored)) == hash_text(*start_of(sim.present()->moment))) {
    sim.journal->append(restart_record(restored).line());
    return;
  }
  sim.journal.reset();
  sim.log(MVS_LOG_WARNING, "the journal ends: the snapshot restored is of another valve");
}

Json begun_record(const Moment &moment) {
  Json json;
  json.set("do", "begin");
  json.set("journal", uint64_t{1});
  json.set("valve", valve_json(*start_of(moment)));
  put_steps(json, plan_steps(moment, {}));
  return json;
}

Json steps_record(const Moment &before, const Moment &after) {
  Json json;
  json.set("do", "apply");
  Json steps = Json::array();
  const auto entries = after.timeline.past.items();
  for (size_t k = before.timeline.past.size(); k < entries.size(); ++k) {
    add_moves(steps, (*entries[k])->moves);
    steps.add(entry_json(**entries[k]));
  }
  add_moves(steps, after.timeline.moves);
  put_steps(json, std::move(steps));
  return json;
}

Json word_record(const char *word) {
  Json json;
  json.set("do", word);
  return json;
}

Json named_record(const char *word, const std::string &name, const Moves &moves) {
  Json json = word_record(word);
  json.set("name", name);
  Json steps = Json::array();
  add_moves(steps, moves);
  put_steps(json, std::move(steps));
  return json;
}

}  // namespace mvs::core
