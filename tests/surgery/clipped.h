// Fixture: a clip of default size, valves of some sizes, and the stitches that a clip made.
#pragma once

#include <vector>

#include "tests/surgery/operated.h"

namespace mvs::core::test {

inline mvs_op_clip clip() {
  return op_of<mvs_op_clip>(MVS_OP_CLIP);
}

inline mvs_parametric_desc of_size(uint32_t vertices) {
  mvs_parametric_desc desc = {};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = vertices;
  return desc;
}

inline std::vector<Chord> stitches(const Model &model) {
  std::vector<Chord> found;
  for (const Chord &chord : model.valve.chords.get()) {
    if (chord.kind == ChordKind::suture) found.push_back(chord);
  }
  return found;
}

}  // namespace mvs::core::test
