// Chordae shortened, slackened, and cut all at once.
#include "tests/stability/case.h"

namespace stability {
namespace {

// Every chord in turn, each from the same start; in short runs every sixteenth.
Case each_chord(const std::string &name, double factor, size_t stride) {
  return {"chords/" + name, [=](Watch &w) {
            const std::vector<mvs_part> chords = w.sim().snapshot().parts(MVS_PART_CHORD);
            for (size_t c = 0; c < chords.size(); c += stride) {
              w.about(chords[c].name);
              mvs_op_chord_length op = {};
              op.chord = chords[c].id;
              op.factor = factor;
              w.operate(op, MVS_OP_CHORD_LENGTH);
              w.rest();
              w.take_back();
            }
          }};
}

// All of them, without a move in between.
void remove_all(Watch &watch) {
  // segments without support are removed with the one that is cut
  while (true) {
    const std::vector<mvs_part> chords = watch.sim().snapshot().parts(MVS_PART_CHORD);
    if (chords.empty()) break;
    mvs_op_chord_remove op = {};
    op.chord = chords.back().id;
    if (!watch.operate(op, MVS_OP_CHORD_REMOVE)) break;
  }
  watch.rest();
}

// All of them, one after the other, to a tenth: the sheet is pulled into the heads.
void shorten_all(Watch &watch) {
  for (const mvs_part &chord : watch.sim().snapshot().parts(MVS_PART_CHORD)) {
    mvs_op_chord_length op = {};
    op.chord = chord.id;
    op.factor = 0.1;
    watch.operate(op, MVS_OP_CHORD_LENGTH);
  }
  watch.rest();
}

}  // namespace

std::vector<Case> chord_cases(bool every_chord) {
  const size_t stride = every_chord ? 1 : 16;
  return {each_chord("each_minus_90", 0.1, stride),
          each_chord("each_plus_200", 3, stride),
          {"chords/all_removed", remove_all},
          {"chords/all_minus_90", shorten_all}};
}

}  // namespace stability
