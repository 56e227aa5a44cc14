// Operation head_move: displaces a papillary head.
#include "base/error.h"
#include "measure/annulus/frame.h"
#include "surgery/surgery.h"

namespace mvs::core {

void operate(Surgery &s, const mvs_op_head_move &op) {
  MVS_MUST(op.reserved == 0, MVS_E_ARGUMENT, "head_move", "head_move.reserved has to be 0");
  const uint32_t index = head_of(s, op.head);
  const Head &head = s.valve.heads.get()[index];
  Vec3 by(op.by[0], op.by[1], op.by[2]);
  MVS_MUST(by.norm() > 0, MVS_E_ARGUMENT, "papillary head " + head.name,
           "head_move: papillary head %s has a displacement of zero: give a distance in m",
           head.name.c_str());
  if (op.frame == 1) by = valve_frame(s.before, s.valve.loaded).axes.transpose() * by;
  s.valve.open[head.node] += by;
  s.valve.loaded[head.node] += by;
  s.title = format("Move papillary head %s by %.1f mm", head.name.c_str(), 1e3 * by.norm());
}

}  // namespace mvs::core
