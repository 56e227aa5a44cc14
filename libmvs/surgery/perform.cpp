// Applying one operation: on copies, checked as any valve is, all or nothing.
#include "base/error.h"
#include "surgery/surgery.h"

namespace mvs {
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

// A valve that the operation spoilt is the operation's failure.
ModelPtr checked_model(Surgery &s) {
  try {
    return make_model(std::move(s.valve), &s.before);
  } catch (const Error &fault) {
    fail(MVS_E_OP, fault.part, "%s would not leave a valve: %s", s.op_name, fault.what());
  }
}

}  // namespace

Operated perform(const Picture &before, const Operation &op) {
  Surgery s{*before.model, before.model->valve, before.state, op.kind().name};
  dispatch(s, op);
  Operated done;
  done.made = s.made;
  done.title = std::move(s.title);
  done.picture.state = std::move(s.state);
  done.picture.model = checked_model(s);
  share(done.picture.state, before.state);
  MVS_MUST(done.picture.state.x.size() == done.picture.model->node_count(), MVS_E_INTERNAL,
           op.kind().name, "%s left %zu positions for %zu nodes", op.kind().name,
           done.picture.state.x.size(), done.picture.model->node_count());
  return done;
}

}  // namespace mvs
