/* A valve from arrays: strides, alignment, single precision, defaults of omitted arrays. */
#include <math.h>
#include <stdlib.h>

#include "check.h"
#include "funnel.h"

static hash128 hash_of_valve(const mvs_valve_desc *desc) {
  mvs_sim *sim = NULL;
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_set_valve(sim, desc));
  hash128 hash = sim_hash(sim);
  mvs_destroy(sim);
  return hash;
}

/* Rows of a packed array, `stride` bytes apart, the first one at an odd address. */
static char *spread(mvs_array *array, uint64_t row, uint64_t stride) {
  char *room = malloc(array->count * stride + 1);
  if (!room) exit(2);
  memset(room, 0x7f, array->count * stride + 1);
  for (uint64_t r = 0; r < array->count; ++r) {
    memcpy(room + 1 + r * stride, (const char *)array->data + r * row, row);
  }
  array->data = room + 1;
  array->stride = stride;
  return room;
}

static void strided_and_misaligned_arrays_give_the_same_valve(void) {
  static funnel f;
  make_funnel(&f);
  hash128 before = hash_of_valve(&f.desc);
  char *room[4] = {spread(&f.desc.nodes, 24, 41), spread(&f.desc.triangles, 12, 13),
                   spread(&f.desc.triangle_leaflet, 4, 9), spread(&f.desc.annulus, 4, 5)};
  CHECK(same_hash(before, hash_of_valve(&f.desc)));
  for (int k = 0; k < 4; ++k) free(room[k]);
}

static void a_stride_that_is_the_packed_one_is_the_same_as_zero(void) {
  static funnel f;
  make_funnel(&f);
  hash128 before = hash_of_valve(&f.desc);
  f.desc.nodes.stride = 24;
  CHECK(same_hash(before, hash_of_valve(&f.desc)));
}

static void single_precision_is_widened(void) {
  static funnel f;
  static float single[FUNNEL_NODES][3];
  make_funnel(&f);
  for (int n = 0; n < FUNNEL_NODES; ++n) {
    for (int k = 0; k < 3; ++k) {
      /* volatile: GCC 12 -O2 leaves the rounding out of the double when it vectorises this */
      volatile float rounded = (float)f.nodes[n][k];
      single[n][k] = rounded;
      f.nodes[n][k] = rounded;
    }
  }
  hash128 twice = hash_of_valve(&f.desc);
  f.desc.nodes = packed(single, FUNNEL_NODES, 3, MVS_TYPE_F32);
  CHECK(same_hash(twice, hash_of_valve(&f.desc)));
}

static void given_defaults_are_the_defaults(void) {
  static funnel f;
  static double thickness[FUNNEL_TRIANGLES];
  make_funnel(&f);
  hash128 before = hash_of_valve(&f.desc);
  for (int t = 0; t < FUNNEL_TRIANGLES; ++t) thickness[t] = 1e-3;
  const char *scallops[2] = {"A", "P"};
  f.desc.triangle_thickness = packed(thickness, FUNNEL_TRIANGLES, 1, MVS_TYPE_F64);
  f.desc.triangle_scallop = f.desc.triangle_leaflet;
  f.desc.scallops = scallops;
  f.desc.scallop_count = 2;
  f.desc.nodes_loaded = f.desc.nodes;
  f.desc.nodes_now = f.desc.nodes;
  f.desc.density = 1060;
  f.desc.contact_thickness = 1e-3;
  f.desc.contact_stiffness = 20e3;
  f.desc.bending_scale = 1;
  for (int l = 0; l < 2; ++l) {
    f.leaflets[l].law = MVS_LEAFLET_LAW_SPRING;
    f.leaflets[l].thickness = 1e-3;
    f.leaflets[l].constants[0] = 100e3;
    f.leaflets[l].constants[1] = 6e6;
    f.leaflets[l].constants[2] = 0.25;
    f.leaflets[l].id = 1 + (mvs_id)l;
  }
  const mvs_id scallop_ids[2] = {3, 4};
  f.desc.scallop_ids = scallop_ids;
  for (int c = 0; c < FUNNEL_CHORDS; ++c) {
    f.chords[c].law = MVS_CHORD_LAW_LINEAR;
    f.chords[c].young = 40e6;
    f.chords[c].area = 7.853981633974483e-7;
  }
  f.heads[0].name = "PM1";
  f.heads[1].name = "PM2";
  CHECK(same_hash(before, hash_of_valve(&f.desc)));
}

static void what_is_given_is_kept(void) {
  static funnel f;
  static double now[FUNNEL_NODES][3], fibre[FUNNEL_TRIANGLES][3];
  make_funnel(&f);
  memcpy(now, f.nodes, sizeof now);
  now[FUNNEL_SHEET - 1][2] -= 1e-3;
  for (int t = 0; t < FUNNEL_TRIANGLES; ++t) fibre[t][2] = -1;
  f.desc.nodes_now = packed(now, FUNNEL_NODES, 3, MVS_TYPE_F64);
  f.desc.triangle_fibre = packed(fibre, FUNNEL_TRIANGLES, 3, MVS_TYPE_F64);
  f.desc.bending_scale = 0;
  f.desc.flags |= MVS_VALVE_FLAG_NO_BENDING;
  f.chords[3].rest_length = 12e-3;
  f.chords[3].name = "strut, left";
  f.chords[3].id = 77;
  mvs_sim *sim = NULL;
  const mvs_snapshot *snapshot = NULL;
  mvs_view view;
  mvs_part part;
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_set_valve(sim, &f.desc));
  MUST(mvs_get_snapshot(sim, &snapshot));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_NODE_POSITION, &view));
  CHECK(same_bits(view.data, now, sizeof now));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_NODE_REST, &view));
  CHECK(same_bits(view.data, f.nodes, sizeof f.nodes));
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_CHORD_REST_LENGTH, &view));
  CHECK(((const double *)view.data)[3] == 12e-3);
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_VALVE_CONSTANTS, &view));
  CHECK(((const double *)view.data)[3] == 0);
  MUST(mvs_snapshot_get_array(snapshot, MVS_ARRAY_TRIANGLE_FIBRE, &view));
  CHECK(((const double *)view.data)[2] < -0.9); /* the walls of the funnel lean by 18 degrees */
  MUST(mvs_snapshot_find_part(snapshot, MVS_PART_CHORD, "strut, left", &part));
  CHECK(part.id == 77 && part.index == 3 && part.kind == MVS_PART_CHORD);
  mvs_snapshot_release(snapshot);
  mvs_destroy(sim);
}

static void the_orient_flag_turns_a_flipped_valve(void) {
  static funnel f;
  make_funnel(&f);
  hash128 before = hash_of_valve(&f.desc);
  for (int t = 0; t < FUNNEL_TRIANGLES; ++t) {
    uint32_t corner = f.triangles[t][1];
    f.triangles[t][1] = f.triangles[t][2];
    f.triangles[t][2] = corner;
  }
  mvs_sim *sim = NULL;
  MUST(mvs_create(NULL, &sim));
  MUST_FAIL(mvs_set_valve(sim, &f.desc), MVS_E_OP, "faces the ventricle");
  mvs_destroy(sim);
  f.desc.flags = MVS_VALVE_FLAG_ORIENT;
  CHECK(same_hash(before, hash_of_valve(&f.desc)));
}

/* The rows of a table of chordae: names, ends, figures of the arrays. */
static void each_chord_is_described(void) {
  mvs_sim *sim;
  const mvs_snapshot *closed;
  mvs_parametric_desc shape = {
      .struct_size = sizeof shape, .branching = 1, .shape = MVS_SHAPE_FOUNDING};
  mvs_load_case load = {.struct_size = sizeof load, .pressure = 16e3, .boundary_fraction = 1};
  mvs_settle_options few = {.struct_size = sizeof few, .max_iterations = 20};
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, &shape));
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_settle(sim, &few, NULL));
  MUST(mvs_get_snapshot(sim, &closed));
  uint32_t count = 0, trunks = 0;
  mvs_view rest, strain, tension;
  MUST(mvs_snapshot_get_part_count(closed, MVS_PART_CHORD, &count));
  MUST(mvs_snapshot_get_array(closed, MVS_ARRAY_CHORD_REST_LENGTH, &rest));
  MUST(mvs_snapshot_get_array(closed, MVS_ARRAY_CHORD_STRAIN, &strain));
  MUST(mvs_snapshot_get_array(closed, MVS_ARRAY_CHORD_TENSION, &tension));
  mvs_chord_info chord = {.struct_size = sizeof chord};
  for (uint32_t c = 0; c < count; ++c) {
    mvs_part part;
    MUST(mvs_snapshot_get_chord(closed, c, &chord));
    MUST(mvs_snapshot_get_part(closed, MVS_PART_CHORD, c, &part));
    CHECK(chord.id == part.id && strcmp(chord.name, part.name) == 0);
    CHECK(chord.rest_length == ((const double *)rest.data)[c]);
    CHECK(chord.strain == ((const double *)strain.data)[c]);
    CHECK(chord.tension == ((const double *)tension.data)[c]);
    /* the definition of strain */
    CHECK(fabs(chord.length - chord.rest_length * (1 + chord.strain)) < 1e-12);
    CHECK(strncmp(chord.heads, "PM", 2) == 0 || strncmp(chord.heads, "AL", 2) == 0);
    CHECK(chord.scallops[0] == 'A' || chord.scallops[0] == 'P');
    trunks += chord.kind == MVS_CHORD_KIND_TRUNK;
  }
  CHECK(trunks > 0);
  MUST_FAIL(mvs_snapshot_get_chord(closed, count, &chord), MVS_E_ARGUMENT, "index");
  MUST_FAIL(mvs_snapshot_get_chord(NULL, 0, &chord), MVS_E_ARGUMENT, "snapshot");
  chord.struct_size = 0;
  CHECK(mvs_snapshot_get_chord(closed, 0, &chord) != MVS_OK);
  mvs_snapshot_release(closed);
  mvs_destroy(sim);
}

/* Six scallops and two commissures add up to the measures; a dilated annulus leaks at A2 and P2. */
static void regions_and_orifice_parts_add_up(void) {
  mvs_sim *sim;
  const mvs_snapshot *closed;
  mvs_parametric_desc shape = {
      .struct_size = sizeof shape, .annulus_scale = 1.2, .shape = MVS_SHAPE_FOUNDING};
  mvs_load_case load = {.struct_size = sizeof load, .pressure = 16e3, .boundary_fraction = 1};
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, &shape));
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_settle(sim, NULL, NULL));
  MUST(mvs_get_snapshot(sim, &closed));
  mvs_measures all = {.struct_size = sizeof all};
  MUST(mvs_snapshot_measure(closed, &all));
  uint32_t regions = 0, parts = 0, commissures = 0;
  double coaptation = 0, orifice = 0, opening = 0;
  MUST(mvs_snapshot_get_region_count(closed, &regions));
  CHECK(regions == 8);
  mvs_region_measures region = {.struct_size = sizeof region};
  for (uint32_t k = 0; k < regions; ++k) {
    MUST(mvs_snapshot_get_region(closed, k, &region));
    commissures += region.kind == MVS_REGION_COMMISSURE;
    if (region.kind != MVS_REGION_SCALLOP) continue;
    coaptation += region.coaptation_area;
    orifice += region.orifice_area;
    if (strcmp(region.name, "A2") == 0) CHECK(region.gap > 1e-3);
  }
  CHECK(commissures == 2);
  CHECK(orifice > 0);
  CHECK(fabs(coaptation - all.coaptation_area) < 1e-15);
  CHECK(fabs(orifice - all.regurgitant_orifice_area) < 1e-15);
  MUST(mvs_snapshot_get_orifice_part_count(closed, &parts));
  mvs_orifice_part part = {.struct_size = sizeof part};
  mvs_view part_of;
  MUST(mvs_snapshot_get_array(closed, MVS_ARRAY_ORIFICE_PART, &part_of));
  uint64_t triangles = 0;
  for (uint32_t k = parts; k-- > 0;) {
    MUST(mvs_snapshot_get_orifice_part(closed, k, &part));
    opening += part.area;
    triangles += part.triangles;
    /* m2: triangles are summed in another order */
    CHECK(part.area <= all.regurgitant_orifice_area + 1e-15);
  }
  CHECK(triangles == part_of.count);
  CHECK(fabs(opening - all.regurgitant_orifice_area) < 1e-15);
  CHECK(part.anterior != NULL && strstr(part.anterior, "A2") != NULL);
  CHECK(part.posterior != NULL && strstr(part.posterior, "P2") != NULL);
  MUST_FAIL(mvs_snapshot_get_region(closed, regions, &region), MVS_E_ARGUMENT, "index");
  MUST_FAIL(mvs_snapshot_get_orifice_part(closed, parts, &part), MVS_E_ARGUMENT, "index");
  MUST_FAIL(mvs_snapshot_get_region(NULL, 0, &region), MVS_E_ARGUMENT, "snapshot");
  MUST_FAIL(mvs_snapshot_get_region_count(closed, NULL), MVS_E_ARGUMENT, "count");
  mvs_snapshot_release(closed);
  mvs_destroy(sim);
}

int main(void) {
  each_chord_is_described();
  regions_and_orifice_parts_add_up();
  strided_and_misaligned_arrays_give_the_same_valve();
  a_stride_that_is_the_packed_one_is_the_same_as_zero();
  single_precision_is_widened();
  given_defaults_are_the_defaults();
  what_is_given_is_kept();
  the_orient_flag_turns_a_flipped_valve();
  return finish("arrays");
}
