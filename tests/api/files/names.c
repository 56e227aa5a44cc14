/* Names are UTF-8: others are refused at every entry, and those of any script survive every file.
 */
#include <stdlib.h>
#include <unistd.h>

#include "tests/api/check.h"
#include "tests/api/funnel.h"
#include "tests/api/repair.h"

#define LATIN "Kopf\xe9"
#define CUT "\xe4\xb8"
#define CJK "\xc3\xa9\xe4\xb8\xad"

static mvs_sim *sim;

/* The valve of a funnel with one name changed is refused, and the simulator keeps its valve. */
#define REFUSED_NAME(change, part)                                          \
  do {                                                                      \
    const hash128 before = sim_hash(sim);                                   \
    make_funnel(&f);                                                        \
    change;                                                                 \
    MUST_FAIL(mvs_set_valve(sim, &f.desc), MVS_E_OP, part);                 \
    MUST_FAIL(mvs_set_valve(sim, &f.desc), MVS_E_OP, "UTF-8");              \
    MUST_FAIL(mvs_check_valve(&f.desc, NULL, NULL), MVS_E_OP, "are UTF-8"); \
    CHECK(same_hash(before, sim_hash(sim)));                                \
  } while (0)

static void parts_of_a_valve(void) {
  static funnel f;
  static const char *scallops[2] = {"A", "P" CUT};
  static mvs_ring_desc ring = {.name = "\xff", .kind = MVS_RING_KIND_RIGID};
  REFUSED_NAME(f.desc.name = LATIN, "the valve");
  REFUSED_NAME(f.leaflets[1].name = LATIN, "leaflet 1");
  REFUSED_NAME(f.chords[3].name = CUT, "chord 3");
  REFUSED_NAME(f.heads[1].name = "\xc0\x80", "papillary head 1");
  REFUSED_NAME(f.desc.scallops = scallops; f.desc.scallop_count = 2;
               f.desc.triangle_scallop = f.desc.triangle_leaflet, "scallop 1");
  REFUSED_NAME(ring.curve = packed(f.nodes, 8, 3, MVS_TYPE_F64); f.desc.rings = &ring;
               f.desc.ring_count = 1; f.desc.ring_stride = sizeof ring, "ring 0");
}

static mvs_op_neochord neochord(const char *name) {
  mvs_op_neochord op = {.op = {sizeof op, MVS_OP_NEOCHORD}, .name = name};
  op.head = named(sim, MVS_PART_HEAD, "PM2");
  op.site = (mvs_site){MVS_SITE_ANATOMICAL, 0, named(sim, MVS_PART_SCALLOP, "P2"), {0.5, 1, 0}};
  return op;
}

static void operations_groups_and_plans(void) {
  const mvs_snapshot *snapshot = NULL;
  mvs_plan_options options = {.struct_size = sizeof options, .author = LATIN};
  mvs_op_ring ring = {.op = {sizeof ring, MVS_OP_RING}, .size = 0.034, .name = "ring\xe9"};
  const hash128 before = sim_hash(sim);
  uint64_t size = 0;
  mvs_op_neochord op = neochord(LATIN);
  MUST_FAIL(mvs_check_op(sim, &op.op), MVS_E_ARGUMENT, "neochord: name is not UTF-8");
  MUST_FAIL(mvs_apply_op(sim, &op.op, NULL), MVS_E_ARGUMENT, "neochord: name is not UTF-8");
  MUST_FAIL(mvs_apply_op(sim, &ring.op, NULL), MVS_E_ARGUMENT, "ring: name is not UTF-8");
  MUST_FAIL(mvs_begin_group(sim, "gr\xff"), MVS_E_ARGUMENT, "group is not UTF-8");
  MUST_FAIL(mvs_set_checkpoint(sim, CUT), MVS_E_ARGUMENT, "checkpoint is not UTF-8");
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST_FAIL(mvs_write_plan(snapshot, &options, NULL, 0, &size), MVS_E_ARGUMENT, "options.author");
  options.author = NULL;
  options.notes = CUT;
  MUST_FAIL(mvs_write_plan(snapshot, &options, NULL, 0, &size), MVS_E_ARGUMENT, "options.notes");
  mvs_snapshot_release(snapshot);
  CHECK(same_hash(before, sim_hash(sim)));
}

static void surfaces(void) {
  static funnel f;
  mvs_surface_desc surface = {.struct_size = sizeof surface, .name = LATIN};
  make_funnel(&f);
  surface.points = packed(f.nodes, FUNNEL_SHEET, 3, MVS_TYPE_F64);
  surface.triangles = f.desc.triangles;
  MUST_FAIL(mvs_build_valve(sim, &surface, NULL, NULL), MVS_E_ARGUMENT, "surface.name");
}

/* The OBJ of the present valve with `old` replaced by `instead`. */
static char *edited(const char *old, const char *instead, uint64_t *size) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_save_memory(snapshot, MVS_FORMAT_OBJ, NULL, 0, size));
  char *text = malloc(*size + 1), *made = malloc(*size + 200);
  if (!text || !made) exit(2);
  MUST(mvs_save_memory(snapshot, MVS_FORMAT_OBJ, text, *size, size));
  mvs_snapshot_release(snapshot);
  text[*size] = 0;
  char *at = strstr(text, old);
  if (!at) exit(2);
  *at = 0;
  *size = (uint64_t)sprintf(made, "%s%s%s", text, instead, at + strlen(old));
  free(text);
  return made;
}

static void obj_files(void) {
  static const char *const names[] = {"name=Kopf%E9", "name=%E4%B8", "name=%C0%80",
                                      "name=%ED%A0%80"};
  for (int k = 0; k < 4; ++k) {
    uint64_t size = 0;
    char *text = edited("name=PM1", names[k], &size);
    MUST_FAIL(mvs_load_memory(sim, text, size, MVS_FORMAT_OBJ), MVS_E_FORMAT, "is not UTF-8");
    CHECK(mvs_last_error()->line > 0);
    free(text);
  }
}

/* A repair with names of another script survives plan, journal, OBJ and a crash. */
static void names_of_any_script_are_kept(void) {
  char path[64];
  uint64_t size = 0;
  mvs_replay replay = {.struct_size = sizeof replay};
  char *text = edited("name=PM2", "name=%C3%A9%E4%B8%AD", &size);
  MUST(mvs_load_memory(sim, text, size, MVS_FORMAT_OBJ));
  snprintf(path, sizeof path, "names_test_%d.journal", (int)getpid());
  remove(path);
  MUST(mvs_open_journal(sim, path));
  mvs_op_neochord op = {.op = {sizeof op, MVS_OP_NEOCHORD}, .name = CJK};
  op.head = named(sim, MVS_PART_HEAD, CJK);
  op.site = (mvs_site){MVS_SITE_ANATOMICAL, 0, named(sim, MVS_PART_SCALLOP, "P2"), {0.5, 1, 0}};
  MUST(mvs_begin_group(sim, CJK));
  MUST(mvs_apply_op(sim, &op.op, NULL));
  MUST(mvs_end_group(sim));
  const hash128 wanted = sim_hash(sim);
  MUST(mvs_close_journal(sim));
  MUST(mvs_load_memory(sim, text, size, MVS_FORMAT_OBJ));
  MUST(mvs_recover_journal(sim, path, &replay));
  CHECK(replay.same_result == 1 && same_hash(wanted, sim_hash(sim)));
  remove(path);
  free(text);
}

int main(void) {
  MUST(mvs_create(NULL, &sim));
  MUST(generate_founding(sim));
  parts_of_a_valve();
  operations_groups_and_plans();
  surfaces();
  obj_files();
  names_of_any_script_are_kept();
  mvs_destroy(sim);
  return finish("names");
}
