/* A wrong valve is refused with its code and a sentence that names the fault, and changes no state.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "funnel.h"
#include "refused.h"

/* A valve with one changed field is refused with this code; a good valve is set afterwards. */
#define REFUSED_VALVE(change, code, word)                        \
  do {                                                           \
    make_funnel(&f);                                             \
    change;                                                      \
    REFUSED(mvs_set_valve(sim, &f.desc), code, word);            \
    MUST_FAIL(mvs_check_valve(&f.desc, NULL, NULL), code, word); \
  } while (0)

static void arrays_that_cannot_be_read(void) {
  REFUSED_VALVE(f.desc.flags = 4, MVS_E_ARGUMENT, "valve.flags is 4");
  REFUSED_VALVE(f.desc.nodes.data = NULL, MVS_E_ARGUMENT, "nodes has 66 entries but is a null");
  REFUSED_VALVE(f.desc.nodes.components = 2, MVS_E_ARGUMENT, "nodes has 2 components");
  REFUSED_VALVE(f.desc.nodes.type = MVS_TYPE_U32, MVS_E_ARGUMENT, "nodes is of MVS_TYPE_U32");
  REFUSED_VALVE(f.desc.nodes.type = MVS_TYPE_U64, MVS_E_ARGUMENT, "nodes is of MVS_TYPE_U64");
  REFUSED_VALVE(f.desc.nodes.type = MVS_TYPE_U8, MVS_E_ARGUMENT, "nodes is of MVS_TYPE_U8");
  REFUSED_VALVE(f.desc.nodes.type = 99, MVS_E_ARGUMENT, "nodes is of no type");
  REFUSED_VALVE(f.desc.nodes.stride = 23, MVS_E_ARGUMENT, "nodes has a stride of 23");
  REFUSED_VALVE(f.desc.nodes.stride = UINT64_MAX, MVS_E_ARGUMENT, "nodes has a stride");
  REFUSED_VALVE(f.desc.nodes.count = UINT64_MAX, MVS_E_MEMORY, "the limit is");
  REFUSED_VALVE(f.desc.triangles.type = MVS_TYPE_F64, MVS_E_ARGUMENT,
                "triangles is of MVS_TYPE_F64");
  REFUSED_VALVE(f.desc.triangles.type = MVS_TYPE_F32, MVS_E_ARGUMENT,
                "triangles is of MVS_TYPE_F32");
  REFUSED_VALVE(f.desc.annulus.components = 3, MVS_E_ARGUMENT, "annulus has 3 components");
  REFUSED_VALVE(f.desc.nodes_now = f.desc.nodes;
                f.desc.nodes_now.count = 5, MVS_E_ARGUMENT, "nodes_now has 5 rows");
  REFUSED_VALVE(f.desc.leaflets = NULL, MVS_E_ARGUMENT, "leaflets has 2 entries but is a null");
  REFUSED_VALVE(f.desc.chords = NULL, MVS_E_ARGUMENT, "chords has 10 entries but is a null");
  REFUSED_VALVE(f.desc.heads = NULL, MVS_E_ARGUMENT, "heads has 2 entries but is a null");
  REFUSED_VALVE(f.desc.scallop_count = 1, MVS_E_ARGUMENT, "scallops has 1 entries but is a null");
  REFUSED_VALVE(f.desc.chord_count = UINT32_MAX, MVS_E_MEMORY, "chords has 4294967295 entries");
  REFUSED_VALVE(f.leaflets[0].reserved = 1, MVS_E_ARGUMENT, "leaflets[].reserved");
  REFUSED_VALVE(f.leaflets[0].constants[7] = 1, MVS_E_OP, "leaflet A has a constant 7");
  REFUSED_VALVE(f.chords[0].constants[5] = NAN, MVS_E_OP, "chord 0 has a constant 5");
  REFUSED_VALVE(f.heads[1].reserved = 1, MVS_E_ARGUMENT, "heads[].reserved");
}

static void start_positions_that_are_none(void) {
  static double now[FUNNEL_NODES][3];
  memcpy(now, f.nodes, sizeof now);
  now[7][1] = NAN;
  REFUSED_VALVE(f.desc.nodes_now = packed(now, FUNNEL_NODES, 3, MVS_TYPE_F64), MVS_E_ARGUMENT,
                "node 7 of nodes_now");
  now[7][1] = 5;
  REFUSED_VALVE(f.desc.nodes_now = packed(now, FUNNEL_NODES, 3, MVS_TYPE_F64), MVS_E_ARGUMENT,
                "node 7 of nodes_now");
}

static void what_is_no_valve(void) {
  REFUSED_VALVE(f.desc.nodes.count = 0, MVS_E_OP, "has no nodes");
  REFUSED_VALVE(memset(&f.desc.nodes, 0, sizeof f.desc.nodes), MVS_E_OP, "has no nodes");
  REFUSED_VALVE(f.triangles[5][0] = 1000, MVS_E_OP, "triangle 5 names node 1000");
  REFUSED_VALVE(f.nodes[9][0] = NAN, MVS_E_OP, "node 9");
  REFUSED_VALVE(f.leaflets[1].name = "", MVS_E_OP, "leaflet 1 has no name");
  REFUSED_VALVE(f.leaflets[1].name = NULL, MVS_E_OP, "leaflet 1 has no name");
  REFUSED_VALVE(f.leaflets[0].law = 7, MVS_E_OP, "law 7");
  REFUSED_VALVE(f.leaflets[0].thickness = -1, MVS_E_OP, "thickness");
  REFUSED_VALVE(f.desc.bending_scale = NAN, MVS_E_OP, "bending scale");
  REFUSED_VALVE(f.chords[2].law = 7, MVS_E_OP, "law 7");
  REFUSED_VALVE(f.chords[2].rest_length = NAN, MVS_E_OP, "rest length");
  const char *scallops[2] = {"all", "none"};
  static uint32_t zeros[FUNNEL_TRIANGLES];
  REFUSED_VALVE(f.desc.scallops = scallops; f.desc.scallop_count = 2;
                f.desc.triangle_scallop = packed(zeros, FUNNEL_TRIANGLES, 1, MVS_TYPE_U32),
                MVS_E_OP, "scallop none has no triangle");
  REFUSED_VALVE(f.desc.triangle_scallop = packed(zeros, FUNNEL_TRIANGLES, 1, MVS_TYPE_U32),
                MVS_E_OP, "names scallop 0");
}

typedef struct told {
  int count;
  char part[8][64], sentence[8][256];
} told;

static void tell(void *user, const char *part, const char *sentence) {
  told *t = user;
  if (t->count < 8) {
    snprintf(t->part[t->count], sizeof t->part[0], "%s", part);
    snprintf(t->sentence[t->count], sizeof t->sentence[0], "%s", sentence);
  }
  ++t->count;
}

static void check_valve_tells_every_fault(void) {
  told t = {0};
  make_funnel(&f);
  MUST(mvs_check_valve(&f.desc, tell, &t));
  CHECK(t.count == 0);
  f.desc.density = -1;
  f.chords[2].area = 0.785;
  f.chords[4].node_b = f.chords[4].node_a;
  MUST_FAIL(mvs_check_valve(&f.desc, tell, &t), MVS_E_OP, "to itself");
  CHECK(t.count == 3);
  CHECK(strcmp(t.part[0], "chord 4") == 0);
  t.count = 0;
  f.desc.nodes.type = 0;
  MUST_FAIL(mvs_check_valve(&f.desc, tell, &t), MVS_E_ARGUMENT, "nodes is of");
  CHECK(t.count == 1 && strcmp(t.part[0], "nodes") == 0);
  CHECK(strcmp(t.sentence[0], mvs_last_error()->message) == 0);
}

int main(void) {
  set_funnel();
  arrays_that_cannot_be_read();
  start_positions_that_are_none();
  what_is_no_valve();
  check_valve_tells_every_fault();
  return finish_unchanged("valve_faults");
}
