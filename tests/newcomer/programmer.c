/* A C programmer with the headers: grasp a leaflet while the valve beats, undo an operation. */
#include <mvs/mvs.h>
#include <stdio.h>

#define MUST(call) \
  if ((call) != MVS_OK) return fprintf(stderr, "%s\n", mvs_last_error()->message), 1

int main(void) {
  mvs_sim *sim;
  const mvs_snapshot *closed;
  mvs_chord_info chord = {.struct_size = sizeof chord};
  mvs_load_case systole = {
      .struct_size = sizeof systole, .pressure = MVS_SYSTOLE_PA, .boundary_fraction = 1};
  double share = 0;
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, NULL));
  MUST(mvs_set_load(sim, &systole));
  MUST(mvs_begin_settle(sim, NULL));
  while (share < 1)
    MUST(mvs_advance_settle(sim, 0.01, &share, NULL)); /* a window answers in between */
  MUST(mvs_get_snapshot(sim, &closed));
  MUST(mvs_snapshot_get_chord(closed, 0, &chord));
  printf("chord %s from %s to %s: %.2f N\n", chord.name, chord.heads, chord.scallops,
         chord.tension);
  mvs_op_chord_length cut = {{sizeof cut, MVS_OP_CHORD_LENGTH}, .chord = chord.id, .factor = 0.8};
  MUST(mvs_apply_op(sim, &cut.op, NULL));
  MUST(mvs_undo(sim));
  for (int k = 0; k < 20; ++k) MUST(mvs_step(sim, NULL));
  mvs_snapshot_release(closed);
  mvs_destroy(sim);
  return 0;
}
