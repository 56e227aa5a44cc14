#include "formats/plan/old_ops.h"

#include <mvs/op.h>

namespace mvs::core {

Operation keeping_length(const Operation &op, const Model &before) {
  if (op.kind().number != MVS_OP_CHORD_TRANSFER) return op;
  mvs_op_chord_transfer meant = op.as<mvs_op_chord_transfer>();
  if (meant.end != MVS_CHORD_END_HEAD || meant.length != 0) return op;
  for (const Chord &chord : before.valve.chords.get()) {
    if (chord.id == meant.chord) meant.length = chord.rest_length;
  }
  return Operation(&meant.op);
}

}  // namespace mvs::core
