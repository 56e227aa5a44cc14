/* The first valve of the founding paper (Tenenholtz et al. 2011): it leaks because its annulus is
 * dilated by 15 % and a chord is 25 % longer. The repair sets the annulus to 97 % and adds two
 * chordae.
 * Build: cc -std=c99 repair.c -o repair $(pkg-config --cflags --libs mvs)
 * Use:   ./repair plan.json */
#include <mvs/mvs.h>
#include <stdio.h>
#include <stdlib.h>

static mvs_sim *sim;

static void must(mvs_result result) {
  if (result == MVS_OK) return;
  fprintf(stderr, "%s: %s\n", mvs_result_name(result), mvs_last_error()->message);
  exit(1);
}

static const mvs_snapshot *present(void) {
  const mvs_snapshot *valve = NULL;
  must(mvs_get_snapshot(sim, &valve));
  return valve;
}

/* Closes the valve, prints three of its measures, and returns the orifice area in m2. */
static double close_and_print(const char *word) {
  const mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  const mvs_snapshot *valve;
  mvs_measures m = {0};
  must(mvs_set_load(sim, &systole));
  must(mvs_settle(sim, NULL, NULL));
  m.struct_size = sizeof m;
  valve = present();
  must(mvs_snapshot_measure(valve, &m));
  mvs_snapshot_release(valve);
  printf("%-11s orifice %5.1f mm2, coaptation area %5.1f mm2, largest chord strain %.1f %%\n", word,
         1e6 * m.regurgitant_orifice_area, 1e6 * m.coaptation_area, 100 * m.max_chord_strain);
  return m.regurgitant_orifice_area;
}

/* Finds the first and the last strut chord of the anterior leaflet, and their papillary heads. */
static void find_struts(mvs_id strut[2], mvs_id head[2]) {
  const mvs_snapshot *valve = present();
  mvs_view kinds, nodes, heads;
  uint32_t c, h;
  mvs_part part;
  must(mvs_snapshot_get_array(valve, MVS_ARRAY_CHORD_KIND, &kinds));
  must(mvs_snapshot_get_array(valve, MVS_ARRAY_CHORD_NODES, &nodes));
  must(mvs_snapshot_get_array(valve, MVS_ARRAY_HEAD_NODES, &heads));
  for (c = 0; c < kinds.count; ++c) {
    const int side = strut[0] != 0;
    if (((const uint32_t *)kinds.data)[c] != MVS_CHORD_KIND_STRUT) continue;
    must(mvs_snapshot_get_part(valve, MVS_PART_CHORD, c, &part));
    strut[side] = part.id;
    for (h = 0; h < heads.count; ++h) {
      if (((const uint32_t *)heads.data)[h] != ((const uint32_t *)nodes.data)[2 * c]) continue;
      must(mvs_snapshot_get_part(valve, MVS_PART_HEAD, h, &part));
      head[side] = part.id;
    }
  }
  mvs_snapshot_release(valve);
}

static void scale_annulus(double factor) {
  mvs_op_annulus_scale op = {{sizeof op, MVS_OP_ANNULUS_SCALE}, 0, 0, 0};
  op.factor = factor;
  must(mvs_apply_op(sim, &op.op, NULL));
}

static void lengthen(mvs_id chord, double factor) {
  mvs_op_chord_length op = {{sizeof op, MVS_OP_CHORD_LENGTH}, 0, 0, 0, {{0}, 0, 0}};
  op.chord = chord;
  op.factor = factor;
  must(mvs_apply_op(sim, &op.op, NULL));
}

/* Adds a chord to the rough zone of A2, as taut as its neighbours. */
static void tie_chord(mvs_id head, double along) {
  mvs_op_chord_add op = {{sizeof op, MVS_OP_CHORD_ADD}, 0, {0}, 0, 0, 0, 0, 0, NULL};
  const mvs_snapshot *valve = present();
  mvs_part a2;
  must(mvs_snapshot_find_part(valve, MVS_PART_SCALLOP, "A2", &a2));
  mvs_snapshot_release(valve);
  op.head = head;
  op.site.how = MVS_SITE_ANATOMICAL;
  op.site.scallop = a2.id;
  op.site.u[0] = along;
  op.site.u[1] = 0.75;
  must(mvs_apply_op(sim, &op.op, NULL));
}

int main(int argc, char **argv) {
  const mvs_parametric_desc founding = {.struct_size = sizeof founding,
                                        .shape = MVS_SHAPE_FOUNDING};
  const mvs_plan_options options = {sizeof options, 1, "examples/repair.c", "valve 1"};
  mvs_id strut[2] = {0, 0}, head[2] = {0, 0};
  const mvs_snapshot *valve;
  double leak, repaired;
  must(mvs_create(NULL, &sim));
  must(mvs_generate_valve(sim, &founding));
  find_struts(strut, head);
  close_and_print("healthy");

  scale_annulus(1.15);
  lengthen(strut[0], 1.25);
  leak = close_and_print("diseased");

  must(mvs_begin_group(sim, "repair"));
  scale_annulus(0.97 / 1.15);
  tie_chord(head[0], 0.4);
  tie_chord(head[1], 0.6);
  must(mvs_end_group(sim));
  repaired = close_and_print("repaired");

  valve = present();
  if (argc > 1) must(mvs_save_plan(valve, &options, argv[1]));
  mvs_snapshot_release(valve);
  must(mvs_undo(sim)); /* undoes the whole repair */
  close_and_print("undone");
  mvs_destroy(sim);
  return leak > 0 && repaired == 0 ? 0 : 1;
}
