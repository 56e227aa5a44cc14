// Operations: checks, applies, undoes and redoes them; groups and checkpoints.
#include <mvs/op.h>

#include "api/sim_call.h"
#include "base/utf8.h"
#include "model/text.h"
#include "session/commit.h"
#include "session/unit_warnings.h"

using namespace mvs::core;

namespace {

std::string checked_name(const char *name, const char *what) {
  must_point(name, what);
  std::string text = name;
  MVS_MUST(!text.empty() && text.size() <= name_limit && is_plain_text(text), MVS_E_ARGUMENT, what,
           "the name of a %s has to have 1 to %zu bytes and no control characters", what,
           name_limit);
  MVS_MUST(is_utf8(text), MVS_E_ARGUMENT, what,
           "the name of the %s is not UTF-8: names are UTF-8, convert it", what);
  return text;
}

}  // namespace

extern "C" {

mvs_result mvs_check_op(const mvs_sim *sim, const mvs_op *op) {
  return at_boundary([&] {
    must_point(sim, "sim");
    const SnapshotPtr present = sim->present();
    perform(present->value.current, Operation(op));
  });
}

mvs_result mvs_apply_op(mvs_sim *sim, const mvs_op *op, mvs_id *made) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    const SnapshotPtr before = s.present();
    Snapshot after = after_op(before->value, Operation(op), s.group, now_ms());
    const std::shared_ptr<const HistoryEntry> entry = after.history.past.top();
    commit(s, std::move(after),
           [&](const Snapshot &next) { return steps_record(before->value, next); });
    if (made) *made = entry->made;
    s.log(MVS_LOG_INFO, "%s", entry->title.c_str());
    log_units(s, *s.present()->model, before->model.get());
  });
}

mvs_result mvs_undo(mvs_sim *sim) {
  return call_at_boundary(sim, [](mvs_sim &s) {
    const SnapshotPtr before = s.present();
    must_be_no_group(s, "undo");
    commit(s, undone(before->value), [](const Snapshot &) { return word_record("undo"); });
  });
}

mvs_result mvs_redo(mvs_sim *sim) {
  return call_at_boundary(sim, [](mvs_sim &s) {
    const SnapshotPtr before = s.present();
    must_be_no_group(s, "redo");
    commit(s, redone(before->value), [](const Snapshot &) { return word_record("redo"); });
  });
}

mvs_result mvs_begin_group(mvs_sim *sim, const char *name) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    const SnapshotPtr before = s.present();
    must_be_no_group(s, "begin_group");
    Group group{before->value.history.next_group, checked_name(name, "group")};
    Snapshot snapshot = before->value;
    ++snapshot.history.next_group;
    s.replace(make_snapshot(std::move(snapshot)));
    s.group = std::move(group);
  });
}

mvs_result mvs_end_group(mvs_sim *sim) {
  return call_at_boundary(sim, [](mvs_sim &s) {
    MVS_MUST(s.group.number != 0, MVS_E_STATE, "group", "end_group: no group is open");
    s.group = {};
    s.make_ready();
  });
}

mvs_result mvs_set_checkpoint(mvs_sim *sim, const char *name) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    const SnapshotPtr before = s.present();
    const std::string text = checked_name(name, "checkpoint");
    commit(s, with_checkpoint(before->value, text), [&](const Snapshot &after) {
      return named_record("checkpoint", text, after.history.events);
    });
  });
}

mvs_result mvs_restore_checkpoint(mvs_sim *sim, const char *name) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    const SnapshotPtr before = s.present();
    must_be_no_group(s, "restore_checkpoint");
    const std::string text = checked_name(name, "checkpoint");
    commit(s, at_checkpoint(before->value, text),
           [&](const Snapshot &) { return named_record("restore_checkpoint", text, {}); });
  });
}

}  // extern "C"
