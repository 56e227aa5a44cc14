// The journal of a simulator: begins, closes and recovers it.
#include "formats/file/journal.h"
#include "api/sim_call.h"

#include <mvs/plan.h>

#include "formats/formats.h"
#include "session/commit.h"
#include "session/replay.h"

using namespace mvs::core;

namespace {

Json parsed(const std::string &text, size_t number) {
  Json json = Json::parse(text);
  MVS_MUST(json.is_object() && json.has("do") && json["do"].is_text(), MVS_E_FORMAT, "journal",
           "record %zu of the journal is not a record of libmvs", number);
  return json;
}

std::string text_at(const Json &json, const char *key) {
  MVS_MUST(json.has(key) && json[key].is_text(), MVS_E_FORMAT, "journal",
           "a record of the journal lacks its %s", key);
  return json[key].text();
}

std::vector<PlanStep> steps_at(const Json &json, const char *key = "steps") {
  MVS_MUST(json.has(key), MVS_E_FORMAT, "journal", "a record of the journal has no %s", key);
  return read_steps(json[key]);
}

// Returns to the state after the last operation: a record has all events since then.
void rewind_moves(Snapshot &now) {
  const ModelState at = now.history.past.empty() ? *start_of(now) : now.history.past.top()->after;
  now.current = at;
  now.history.events = {};
}

// Replays the steps to a snapshot; then those that were undone there, so that they can be redone.
void run_to(Replay &replay, const Json &json) {
  replay.run(steps_at(json));
  if (!json.has("undone")) return;
  const Snapshot present = replay.now;
  rewind_moves(replay.now);
  replay.run(steps_at(json, "undone"));
  while (replay.now.history.past.size() > present.history.past.size()) {
    replay.now = undone(replay.now);
  }
  replay.now.current = present.current;
  replay.now.history.events = present.history.events;
}

// Replays the first record or a restart record: the steps to each checkpoint, then the steps to the
// snapshot.
void restart(Replay &replay, const Json &record) {
  Replay there({*start_of(replay.now), {}}, replay);
  static const Json none = Json::array();
  for (const Json &checkpoint :
       (record.has("checkpoints") ? record["checkpoints"] : none).items()) {
    there.now = {*start_of(replay.now), {nullptr, {}, {}, {}, there.now.history.checkpoints, 1}};
    run_to(there, checkpoint);
    there.now = with_checkpoint(there.now, text_at(checkpoint, "name"));
  }
  there.now = {*start_of(replay.now), {nullptr, {}, {}, {}, there.now.history.checkpoints, 1}};
  run_to(there, record);
  replay = std::move(there);
}

// Replays one record after the first.
void redo(Replay &replay, const Json &record) {
  const std::string word = text_at(record, "do");
  if (word == "restart") return restart(replay, record);
  if (record.has("steps")) {
    rewind_moves(replay.now);
    replay.run(steps_at(record));
  }
  if (word == "undo") {
    replay.now = undone(replay.now);
  } else if (word == "redo") {
    replay.now = redone(replay.now);
  } else if (word == "checkpoint") {
    replay.now = with_checkpoint(replay.now, text_at(record, "name"));
  } else if (word == "restore_checkpoint") {
    replay.now = at_checkpoint(replay.now, text_at(record, "name"));
  } else {
    MVS_MUST(word == "apply", MVS_E_VERSION, "journal",
             "the journal has a record \"%.40s\", which this libmvs does not know", word.c_str());
  }
}

// The valve where the history of a journal begins: the present one, or that of the present session
// if it is the one on which the journal was opened. Any other session has operations that would be
// lost.
ModelState beginning(const Json &first, const Snapshot &present) {
  MVS_MUST(text_at(first, "do") == "begin" && first.has("valve"), MVS_E_FORMAT, "journal",
           "the journal does not begin with its valve");
  check_plan_version(first, "journal");
  const std::string wanted = text_at(first["valve"], "hash"), found = hash_text(present.current);
  if (wanted == found) return present.current;
  const auto start = start_of(present);
  const bool was_opened_here = first.has("present") && hash_text(*start) == wanted &&
                               text_at(first["present"], "hash") == found;
  MVS_MUST(was_opened_here, MVS_E_STATE, "journal",
           "the journal belongs to the valve \"%.63s\" with hash %s, the present one has %s: load "
           "that valve first, or the session on which the journal was opened",
           text_at(first["valve"], "name").c_str(), wanted.c_str(), found.c_str());
  return *start;
}

}  // namespace

extern "C" {

mvs_result mvs_open_journal(mvs_sim *sim, const char *path) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    must_point(path, "path");
    MVS_MUST(!s.journal, MVS_E_STATE, "journal", "the journal %s is open: close it first",
             s.journal->path().c_str());
    const SnapshotPtr present = s.present();
    const std::string first = begun_record(present->value).line();
    s.journal = std::make_unique<Journal>(Journal::create(path, first));
  });
}

mvs_result mvs_close_journal(mvs_sim *sim) {
  return call_at_boundary(sim, [](mvs_sim &s) {
    MVS_MUST(s.journal, MVS_E_STATE, "journal", "no journal is open");
    const std::unique_ptr<const Journal> closed = std::move(s.journal);
    closed->must_exist();
  });
}

mvs_result mvs_recover_journal(mvs_sim *sim, const char *path, mvs_replay *replay) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    must_point(path, "path");
    if (replay) checked_struct_size(replay, "replay");
    MVS_MUST(!s.journal, MVS_E_STATE, "journal", "the journal %s is open: close it first",
             s.journal->path().c_str());
    const SnapshotPtr present = s.present();
    const JournalRecords records = read_journal(read_whole_file(path));
    const Json first = parsed(records.texts[0], 1);
    Replay steps({beginning(first, present->value), {}}, true, event_runner(s));
    restart(steps, first);
    for (size_t k = 1; k < records.texts.size(); ++k) {
      redo(steps, parsed(records.texts[k], k + 1));
    }
    mvs_replay how = {};
    how.operations = static_cast<uint32_t>(steps.now.history.past.size());
    how.same_valve = 1;
    how.same_result = !records.torn;
    if (records.torn) {
      s.log(MVS_LOG_WARNING,
            "the last record of the journal is cut short or damaged, and is left out");
    }
    SnapshotPtr next = make_snapshot(std::move(steps.now));
    s.journal = std::make_unique<Journal>(Journal::reopen(path, records));
    s.replace(std::move(next));
    s.group = {};
    if (replay) write_struct(replay, how, "replay");
  });
}

}  // extern "C"
