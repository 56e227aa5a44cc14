/* A C programmer: settles while a window answers, reads a chord, cuts and undoes, steps. */
#include <mvs/mvs.h>
#include <stdio.h>

#define MUST(call) \
  if ((call) != MVS_OK) return fprintf(stderr, "%s\n", mvs_last_error()->message), 1

int main(void) {
  mvs_sim *sim;
  const mvs_snapshot *closed;
  mvs_chord_info chord = {.struct_size = sizeof chord};
  mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  double share = 0;
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, NULL));
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_begin_settle(sim, NULL));
  while (share < 1) MUST(mvs_advance_settle(sim, 0.01, &share, NULL));
  MUST(mvs_get_snapshot(sim, &closed));
  MUST(mvs_snapshot_get_chord(closed, 0, &chord));
  printf("%s from %s: %.2f N\n", chord.name, chord.heads, chord.tension);
  mvs_op_chord_length cut = {{sizeof cut, MVS_OP_CHORD_LENGTH}, .chord = chord.id, .factor = 0.8};
  MUST(mvs_apply_op(sim, &cut.op, NULL));
  MUST(mvs_undo(sim));
  for (int k = 0; k < 20; ++k) MUST(mvs_step(sim, NULL));
  mvs_snapshot_release(closed);
  mvs_destroy(sim);
  return 0;
}
