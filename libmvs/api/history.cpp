// Enumerates the history of a snapshot, its checkpoints, and the kinds of operations.
#include <mvs/op.h>

#include "api/structs.h"
#include "base/utf8.h"
#include "session/snapshot.h"

using namespace mvs::core;

namespace {

// Returns entry `index`: applied operations, oldest first, then undone ones in the order of redo.
const HistoryEntry &entry_at(const History &history, uint32_t index) {
  const size_t done = history.past.size(), count = done + history.future.size();
  MVS_MUST(index < count, MVS_E_ARGUMENT, "index", "index is %u, but the history has %zu entries",
           index, count);
  if (index < done) return **history.past.items()[index];
  return **history.future.items()[count - 1 - index];
}

const OpKind &kind_at(uint32_t index) {
  MVS_MUST(index < op_kinds().size(), MVS_E_ARGUMENT, "index",
           "index is %u, but there are %zu kinds of operations", index, op_kinds().size());
  return op_kinds()[index];
}

}  // namespace

extern "C" {

mvs_result mvs_snapshot_get_history(const mvs_snapshot *snapshot, mvs_history *history) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    const History &found = snapshot->value.history;
    mvs_history out = {};
    out.done = static_cast<uint32_t>(found.past.size());
    out.undone = static_cast<uint32_t>(found.future.size());
    if (found.checkpoints) out.checkpoints = static_cast<uint32_t>(found.checkpoints->size());
    write_struct(history, out, "history");
  });
}

mvs_result mvs_snapshot_get_history_entry(const mvs_snapshot *snapshot, uint32_t index,
                                          mvs_history_entry *entry) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    const HistoryEntry &found = entry_at(snapshot->value.history, index);
    mvs_history_entry out = {};
    out.kind = found.op.kind().number;
    out.group = found.group;
    out.made = found.made;
    copy_text(out.title, found.title);
    copy_text(out.in_group, found.group_name);
    write_struct(entry, out, "entry");
  });
}

mvs_result mvs_snapshot_get_checkpoint(const mvs_snapshot *snapshot, uint32_t index,
                                       const char **name) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    must_point(name, "name");
    const auto &list = snapshot->value.history.checkpoints;
    const size_t count = list ? list->size() : 0;
    MVS_MUST(index < count, MVS_E_ARGUMENT, "index", "index is %u, but there are %zu checkpoints",
             index, count);
    *name = (*list)[index].name.c_str();
  });
}

uint32_t mvs_get_op_count(void) {
  return static_cast<uint32_t>(op_kinds().size());
}

mvs_result mvs_get_op_info(uint32_t index, mvs_op_info *info) {
  return at_boundary([&] {
    const OpKind &kind = kind_at(index);
    mvs_op_info out = {};
    out.kind = kind.number;
    out.size = kind.size;
    out.fields = static_cast<uint32_t>(kind.fields.size());
    out.name = kind.name;
    out.help = kind.help;
    write_struct(info, out, "info");
  });
}

mvs_result mvs_get_op_field(uint32_t index, uint32_t field, mvs_field_info *info) {
  return at_boundary([&] {
    const OpKind &kind = kind_at(index);
    MVS_MUST(field < kind.fields.size(), MVS_E_ARGUMENT, "field",
             "field is %u, but %s has %zu fields", field, kind.name, kind.fields.size());
    const OpField &f = kind.fields[field];
    mvs_field_info out = {};
    out.type = f.type;
    out.offset = f.offset;
    out.required = f.required ? 1 : 0;
    out.low = f.low;
    out.high = f.high;
    out.name = f.name;
    out.label = f.name;
    out.unit = f.unit;
    out.help = f.help;
    out.choices = f.choices;
    out.default_text = default_of(f).text.c_str();
    out.default_value = default_of(f).value;
    out.group_name = "";
    write_struct(info, out, "info");
  });
}

}  // extern "C"
