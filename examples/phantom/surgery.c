/* Operations of the keys on the valve. An impossible operation reports its error and changes
 * nothing. */
#include <math.h>
#include <stdio.h>

#include "phantom.h"

/* Arguments of the action of a key. */
typedef struct situation {
  mvs_sim *sim;
  const mvs_device_report *hand;
  mvs_id chord;
  const char *out;
} situation;

static mvs_result set_length(const situation *s, double factor) {
  mvs_op_chord_length op = {{sizeof op, MVS_OP_CHORD_LENGTH}, 0, 0, 0, {{0}, 0, 0}};
  op.chord = s->chord;
  op.factor = factor;
  return mvs_apply_op(s->sim, &op.op, NULL);
}

static mvs_result lengthen(const situation *s) {
  return set_length(s, 1.05);
}

static mvs_result shorten(const situation *s) {
  return set_length(s, 1 / 1.05);
}

static mvs_result cut(const situation *s) {
  mvs_op_chord_remove op = {{sizeof op, MVS_OP_CHORD_REMOVE}, 0};
  op.chord = s->chord;
  return mvs_apply_op(s->sim, &op.op, NULL);
}

static double distance2(const double a[3], const double b[3]) {
  return pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2);
}

static mvs_id nearest_head(const mvs_snapshot *valve, uint32_t node) {
  mvs_view place, heads;
  const double *x;
  const uint32_t *at;
  mvs_part part = {0};
  uint32_t i, best = 0;
  must(mvs_snapshot_get_array(valve, MVS_ARRAY_NODE_POSITION, &place));
  must(mvs_snapshot_get_array(valve, MVS_ARRAY_HEAD_NODES, &heads));
  x = place.data;
  at = heads.data;
  for (i = 1; i < heads.count; ++i) {
    if (distance2(x + 3 * at[i], x + 3 * node) < distance2(x + 3 * at[best], x + 3 * node))
      best = i;
  }
  if (heads.count > 0) must(mvs_snapshot_get_part(valve, MVS_PART_HEAD, best, &part));
  return part.id;
}

/* Adds an artificial chord to the leaflet vertex nearest to the hand. */
static mvs_result tie(const situation *s) {
  mvs_op_neochord op = {{sizeof op, MVS_OP_NEOCHORD}, 0, {0}, 0, 0, 0, 0, 0, NULL};
  const mvs_snapshot *valve;
  must(mvs_get_snapshot(s->sim, &valve));
  op.site.how = MVS_SITE_NODE;
  op.site.index = s->hand->near_node;
  if (s->hand->near_node != UINT32_MAX) op.head = nearest_head(valve, s->hand->near_node);
  mvs_snapshot_release(valve);
  return mvs_apply_op(s->sim, &op.op, NULL);
}

static mvs_result dilate(const situation *s) {
  mvs_op_annulus_scale op = {{sizeof op, MVS_OP_ANNULUS_SCALE}, 1.15, 0, 0};
  return mvs_apply_op(s->sim, &op.op, NULL);
}

/* Implants a ring of about the width of the shipped annulus. */
static mvs_result sew_ring(const situation *s) {
  mvs_op_ring op = {{sizeof op, MVS_OP_RING}, {0}, 0, 0, 0, {0}, {0}, NULL};
  op.size = 0.034;
  return mvs_apply_op(s->sim, &op.op, NULL);
}

static mvs_result undo(const situation *s) {
  return mvs_undo(s->sim);
}

static mvs_result redo(const situation *s) {
  return mvs_redo(s->sim);
}

static mvs_result switch_pressure(const situation *s) {
  mvs_load_case load = {0};
  load.struct_size = sizeof load;
  must(mvs_get_load(s->sim, &load));
  load.pressure = load.pressure > 0 ? 0 : MVS_SYSTOLE_PA;
  load.boundary_fraction = load.pressure > 0 ? 1 : 0;
  return mvs_set_load(s->sim, &load);
}

/* No action: the caller prints the orifice after every key. */
static mvs_result measure(const situation *s) {
  (void)s;
  return MVS_OK;
}

static mvs_result save(const situation *s) {
  char path[1024];
  const mvs_snapshot *valve;
  mvs_result result;
  snprintf(path, sizeof path, "%s.obj", s->out);
  must(mvs_get_snapshot(s->sim, &valve));
  result = mvs_save_file(valve, path, MVS_FORMAT_OBJ);
  mvs_snapshot_release(valve);
  return result;
}

static mvs_result write_plan(const situation *s) {
  const mvs_plan_options with = {sizeof with, 0, "examples/phantom.c", NULL};
  char path[1024];
  const mvs_snapshot *valve;
  mvs_result result;
  snprintf(path, sizeof path, "%s.json", s->out);
  must(mvs_get_snapshot(s->sim, &valve));
  result = mvs_save_plan(valve, &with, path);
  mvs_snapshot_release(valve);
  return result;
}

static const struct {
  char key;
  int operates;
  const char *what;
  mvs_result (*act)(const situation *);
} keys[] = {{'+', 1, "lengthen the selected chord by 5 %", lengthen},
            {'-', 1, "shorten it by 5 %", shorten},
            {'x', 1, "cut it", cut},
            {'t', 1, "tie an artificial chord to the leaflet at the hand", tie},
            {'d', 1, "dilate the annulus by 15 %", dilate},
            {'o', 1, "implant a ring of size 34", sew_ring},
            {'u', 0, "undo", undo},
            {'r', 0, "redo", redo},
            {'p', 0, "pressure off, on", switch_pressure},
            {'m', 0, "measure", measure},
            {'s', 0, "save the valve", save},
            {'w', 0, "write the plan", write_plan}};

enum { KEYS = sizeof keys / sizeof keys[0] };

void surgery_help(void) {
  int i;
  for (i = 0; i < KEYS; ++i) printf("  %c  %s\n", keys[i].key, keys[i].what);
}

int is_surgery_key(int key) {
  int i;
  for (i = 0; i < KEYS; ++i) {
    if (keys[i].key == key) return 1;
  }
  return 0;
}

/* The title of the last operation: "Shorten chord P2/3 to 75 %". */
static const char *title(mvs_sim *sim) {
  static mvs_history_entry entry;
  const mvs_snapshot *valve;
  mvs_history history = {0};
  history.struct_size = sizeof history;
  entry.struct_size = sizeof entry;
  must(mvs_get_snapshot(sim, &valve));
  must(mvs_snapshot_get_history(valve, &history));
  must(mvs_snapshot_get_history_entry(valve, history.done - 1, &entry));
  mvs_snapshot_release(valve);
  return entry.title;
}

const char *surgery(mvs_sim *sim, int key, const mvs_device_report *hand, mvs_id chord,
                    const char *out) {
  const situation s = {sim, hand, chord, out};
  int i;
  for (i = 0; i < KEYS; ++i) {
    if (keys[i].key != key) continue;
    if (keys[i].act(&s) != MVS_OK) return mvs_last_error()->message;
    return keys[i].operates ? title(sim) : keys[i].what;
  }
  return NULL;
}

const char *surgery_drag(mvs_sim *sim, mvs_id chord, const double to[3]) {
  mvs_op_chord_length op = {{sizeof op, MVS_OP_CHORD_LENGTH}, 0, 0, 0, {{0}, 1, 0}};
  int k;
  op.chord = chord;
  for (k = 0; k < 3; ++k) op.drag_to.at[k] = to[k];
  return mvs_apply_op(sim, &op.op, NULL) == MVS_OK ? title(sim) : mvs_last_error()->message;
}
