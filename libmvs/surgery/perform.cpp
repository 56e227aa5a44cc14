// Dispatches an operation to its function and validates the resulting valve.
#include "surgery/perform.h"

#include "base/error.h"
#include "surgery/leaflet/site.h"
#include "surgery/surgery.h"

namespace mvs::core {
namespace {

void dispatch(Surgery &s, const Operation &op) {
  switch (op.kind().number) {
#define OPERATION(NUMBER, op_name, help) \
  case MVS_OP_##NUMBER:                  \
    return operate(s, op.as<mvs_op_##op_name>());
#define FIELD(...)
#include "surgery/ops.def"
#undef OPERATION
#undef FIELD
    default:
      fail(MVS_E_INTERNAL, op.kind().name, "%s has no code", op.kind().name);
  }
}

// Checks that every part that an operation names exists, including unused ones: a plan identifies
// parts by name.
void check_parts(const Surgery &s, const Operation &op) {
  for (const OpField &f : op.kind().fields) {
    const bool names_part =
        f.type == MVS_FIELD_CHORD || f.type == MVS_FIELD_HEAD || f.type == MVS_FIELD_SCALLOP;
    if (f.type == MVS_FIELD_SITE) check_site(s, op.field<mvs_site>(f));
    if (!names_part || op.field<Id>(f) == 0) continue;
    if (f.type == MVS_FIELD_CHORD) chord_of(s, op.field<Id>(f));
    if (f.type == MVS_FIELD_HEAD) head_of(s, op.field<Id>(f));
    if (f.type == MVS_FIELD_SCALLOP) scallop_of(s, op.field<Id>(f));
  }
}

// Builds the model; reports an invalid valve as a failure of the operation.
ModelPtr checked_model(Surgery &s) {
  try {
    return make_model(std::move(s.valve), &s.before);
  } catch (const Error &fault) {
    fail(MVS_E_OP, fault.part, "%s: the result is not a valid valve: %s", s.op_name, fault.what());
  }
}

}  // namespace

Operated perform(const ModelState &before, const Operation &op) {
  Surgery s{*before.model, before.model->valve, before.state, op.kind().name};
  check_parts(s, op);
  dispatch(s, op);
  Operated done;
  done.made = s.made;
  done.title = std::move(s.title);
  done.current.state = std::move(s.state);
  done.current.model = checked_model(s);
  done.current.state.drop_cache();
  done.current.state.rest_tolerance = 0;
  drop_lost_tools(*done.current.model, done.current.state);
  share(done.current.state, before.state);
  MVS_MUST(done.current.state.x.size() == done.current.model->node_count(), MVS_E_INTERNAL,
           op.kind().name, "%s left %zu positions for %zu nodes", op.kind().name,
           done.current.state.x.size(), done.current.model->node_count());
  return done;
}

}  // namespace mvs::core
