/* Every array, part and measure of a snapshot: sizes, types, values with a closed form. */
#include <math.h>
#include <stdlib.h>

#include "check.h"
#include "funnel.h"

typedef struct expected {
  uint32_t which, components, type;
  uint64_t count;
} expected;

#define ANY UINT64_MAX

static const expected arrays[] = {
    {MVS_ARRAY_NODE_POSITION, 3, MVS_TYPE_F64, FUNNEL_NODES},
    {MVS_ARRAY_NODE_REST, 3, MVS_TYPE_F64, FUNNEL_NODES},
    {MVS_ARRAY_NODE_LOADED, 3, MVS_TYPE_F64, FUNNEL_NODES},
    {MVS_ARRAY_NODE_VELOCITY, 3, MVS_TYPE_F64, FUNNEL_NODES},
    {MVS_ARRAY_NODE_KIND, 1, MVS_TYPE_U8, FUNNEL_NODES},
    {MVS_ARRAY_NODE_FORCE, 3, MVS_TYPE_F64, FUNNEL_NODES},
    {MVS_ARRAY_NODE_CONTACT_FORCE, 3, MVS_TYPE_F64, FUNNEL_NODES},
    {MVS_ARRAY_NODE_COAPTATION, 1, MVS_TYPE_F64, FUNNEL_NODES},
    {MVS_ARRAY_NODE_OPEN, 3, MVS_TYPE_F64, FUNNEL_NODES},
    {MVS_ARRAY_NODE_ORIGIN, 1, MVS_TYPE_U32, FUNNEL_NODES},
    {MVS_ARRAY_NODE_STRAIN_FIBRE, 3, MVS_TYPE_F64, FUNNEL_NODES},
    {MVS_ARRAY_NODE_STRESS_FIBRE, 3, MVS_TYPE_F64, FUNNEL_NODES},
    {MVS_ARRAY_NODE_MODE, 3, MVS_TYPE_F64, FUNNEL_NODES},
    {MVS_ARRAY_TRIANGLE_NODES, 3, MVS_TYPE_U32, FUNNEL_TRIANGLES},
    {MVS_ARRAY_TRIANGLE_LEAFLET, 1, MVS_TYPE_U32, FUNNEL_TRIANGLES},
    {MVS_ARRAY_TRIANGLE_SCALLOP, 1, MVS_TYPE_U32, FUNNEL_TRIANGLES},
    {MVS_ARRAY_TRIANGLE_THICKNESS, 1, MVS_TYPE_F64, FUNNEL_TRIANGLES},
    {MVS_ARRAY_TRIANGLE_FIBRE, 3, MVS_TYPE_F64, FUNNEL_TRIANGLES},
    {MVS_ARRAY_TRIANGLE_STRETCH, 2, MVS_TYPE_F64, FUNNEL_TRIANGLES},
    {MVS_ARRAY_TRIANGLE_STRESS, 2, MVS_TYPE_F64, FUNNEL_TRIANGLES},
    {MVS_ARRAY_TRIANGLE_COAPTED, 1, MVS_TYPE_F64, FUNNEL_TRIANGLES},
    {MVS_ARRAY_TRIANGLE_STRAIN_FIBRE, 3, MVS_TYPE_F64, FUNNEL_TRIANGLES},
    {MVS_ARRAY_TRIANGLE_STRESS_FIBRE, 3, MVS_TYPE_F64, FUNNEL_TRIANGLES},
    {MVS_ARRAY_LEAFLET_LAW, 1, MVS_TYPE_U32, 2},
    {MVS_ARRAY_LEAFLET_CONSTANTS, 9, MVS_TYPE_F64, 2},
    {MVS_ARRAY_TRIANGLE_DIRECTION, 3, MVS_TYPE_F64, FUNNEL_TRIANGLES},
    {MVS_ARRAY_ANNULUS_NODES, 1, MVS_TYPE_U32, FUNNEL_SEGMENTS},
    {MVS_ARRAY_FREE_EDGE_NODES, 1, MVS_TYPE_U32, FUNNEL_SEGMENTS},
    {MVS_ARRAY_ANNULUS_FORCE, 3, MVS_TYPE_F64, FUNNEL_SEGMENTS},
    {MVS_ARRAY_CHORD_NODES, 2, MVS_TYPE_U32, FUNNEL_CHORDS},
    {MVS_ARRAY_CHORD_REST_LENGTH, 1, MVS_TYPE_F64, FUNNEL_CHORDS},
    {MVS_ARRAY_CHORD_KIND, 1, MVS_TYPE_U32, FUNNEL_CHORDS},
    {MVS_ARRAY_CHORD_STRAIN, 1, MVS_TYPE_F64, FUNNEL_CHORDS},
    {MVS_ARRAY_CHORD_TENSION, 1, MVS_TYPE_F64, FUNNEL_CHORDS},
    {MVS_ARRAY_CHORD_ID, 1, MVS_TYPE_U64, FUNNEL_CHORDS},
    {MVS_ARRAY_CHORD_YOUNG, 1, MVS_TYPE_F64, FUNNEL_CHORDS},
    {MVS_ARRAY_CHORD_AREA, 1, MVS_TYPE_F64, FUNNEL_CHORDS},
    {MVS_ARRAY_CHORD_FLAGS, 1, MVS_TYPE_U8, FUNNEL_CHORDS},
    {MVS_ARRAY_CHORD_LAW, 1, MVS_TYPE_U32, FUNNEL_CHORDS},
    {MVS_ARRAY_HEAD_NODES, 1, MVS_TYPE_U32, 2},
    {MVS_ARRAY_HEAD_FORCE, 3, MVS_TYPE_F64, 2},
    {MVS_ARRAY_CHORD_CONSTANTS, 6, MVS_TYPE_F64, FUNNEL_CHORDS},
    {MVS_ARRAY_RING_POINTS, 3, MVS_TYPE_F64, 0},
    {MVS_ARRAY_RING_START, 1, MVS_TYPE_U32, 1},
    {MVS_ARRAY_RING_KIND, 1, MVS_TYPE_U32, 0},
    {MVS_ARRAY_RING_ID, 1, MVS_TYPE_U64, 0},
    {MVS_ARRAY_ORIFICE_VERTICES, 3, MVS_TYPE_F64, ANY},
    {MVS_ARRAY_ORIFICE_TRIANGLES, 3, MVS_TYPE_U32, ANY},
    {MVS_ARRAY_ORIFICE_PART, 1, MVS_TYPE_U32, ANY},
    {MVS_ARRAY_CURVE_POINTS, 2, MVS_TYPE_F64, 0},
    {MVS_ARRAY_CURVE_START, 1, MVS_TYPE_U32, 1},
    {MVS_ARRAY_VALVE_CONSTANTS, 1, MVS_TYPE_F64, 4},
    {MVS_ARRAY_STATE_TIME, 1, MVS_TYPE_F64, 1},
};

static funnel f;
static const mvs_snapshot *snapshot;

static mvs_view view_of(uint32_t which) {
  mvs_view view = {0};
  MUST(mvs_snapshot_get_array(snapshot, which, &view));
  return view;
}

static void every_array_has_its_size_and_type(void) {
  const uint64_t size[6] = {0, 8, 4, 4, 8, 1};
  for (size_t k = 0; k < sizeof arrays / sizeof *arrays; ++k) {
    mvs_view view = view_of(arrays[k].which);
    if (arrays[k].count != ANY && view.count != arrays[k].count) {
      printf("array %u has %d rows\n", arrays[k].which, (int)view.count);
    }
    CHECK(arrays[k].count == ANY || view.count == arrays[k].count);
    CHECK(view.components == arrays[k].components);
    CHECK(view.type == arrays[k].type);
    CHECK(view.stride == view.components * size[view.type]);
    CHECK(view.data != NULL || view.count == 0);
    mvs_view again = view_of(arrays[k].which);
    CHECK(again.data == view.data); /* computed once, at a fixed address */
  }
}

static void every_number_between_names_an_array_or_none(void) {
  for (uint32_t which = 0, next = 0; which < 100; ++which) {
    mvs_view view;
    int known = next < sizeof arrays / sizeof *arrays && arrays[next].which == which;
    if (known) ++next;
    CHECK((mvs_snapshot_get_array(snapshot, which, &view) == MVS_OK) == known);
  }
}

static void arrays_show_what_was_set(void) {
  CHECK(same_bits(view_of(MVS_ARRAY_NODE_POSITION).data, f.nodes, sizeof f.nodes));
  CHECK(same_bits(view_of(MVS_ARRAY_TRIANGLE_NODES).data, f.triangles, sizeof f.triangles));
  CHECK(same_bits(view_of(MVS_ARRAY_TRIANGLE_LEAFLET).data, f.leaflet, sizeof f.leaflet));
  CHECK(same_bits(view_of(MVS_ARRAY_ANNULUS_NODES).data, f.annulus, sizeof f.annulus));
  const uint32_t *ends = view_of(MVS_ARRAY_CHORD_NODES).data,
                 *kind = view_of(MVS_ARRAY_CHORD_KIND).data;
  for (int c = 0; c < FUNNEL_CHORDS; ++c) {
    CHECK(ends[2 * c] == f.chords[c].node_a && ends[2 * c + 1] == f.chords[c].node_b);
    CHECK(kind[c] == f.chords[c].kind);
  }
  const double *constants = view_of(MVS_ARRAY_LEAFLET_CONSTANTS).data;
  CHECK(constants[0] == 1e-3 && constants[1] == 100e3 && constants[2] == 6e6);
  CHECK(constants[3] == 0.25 && constants[4] == 0);
  const uint8_t *node_kind = view_of(MVS_ARRAY_NODE_KIND).data;
  CHECK(node_kind[0] == MVS_NODE_KIND_ANNULUS &&
        node_kind[FUNNEL_SEGMENTS] == MVS_NODE_KIND_LEAFLET);
  CHECK(node_kind[FUNNEL_SHEET] == MVS_NODE_KIND_HEAD);
}

static void parts_are_found_by_index_and_name(void) {
  const uint32_t counts[5] = {0, 2, 2, FUNNEL_CHORDS, 2};
  for (uint32_t kind = MVS_PART_LEAFLET; kind <= MVS_PART_HEAD; ++kind) {
    uint32_t count = 0;
    MUST(mvs_snapshot_get_part_count(snapshot, kind, &count));
    CHECK(count == counts[kind]);
    for (uint32_t k = 0; k < count; ++k) {
      mvs_part part, found;
      MUST(mvs_snapshot_get_part(snapshot, kind, k, &part));
      CHECK(part.index == k && part.kind == kind && part.id != 0 && part.name[0] != 0);
      MUST(mvs_snapshot_find_part(snapshot, kind, part.name, &found));
      CHECK(same_bits(&part, &found, sizeof part));
    }
  }
}

/* The annulus lies in z = 0, a circle of 15 mm cut to 16 sides; the ventricle is below. */
static void measures_of_the_open_funnel(void) {
  mvs_measures m = {.struct_size = sizeof m}, again = {.struct_size = sizeof again};
  MUST(mvs_snapshot_measure(snapshot, &m));
  MUST(mvs_snapshot_measure(snapshot, &again));
  CHECK(same_bits(&m, &again, sizeof m));
  double perimeter = 16 * 30e-3 * sin(3.14159265358979 / 16);
  CHECK(fabs(m.annulus_perimeter - perimeter) < 1e-12); /* rounding of pi in the funnel */
  CHECK(m.intersections == 0);
  CHECK(m.regurgitant_orifice_area > 0);
  CHECK(m.max_leaflet_strain < 1e-12 && m.max_chord_strain < 1e-12); /* nothing is stretched */
}

static void the_frame_points_into_the_atrium(void) {
  double frame[12];
  MUST(mvs_snapshot_get_frame(snapshot, frame));
  for (int k = 0; k < 3; ++k) CHECK(fabs(frame[k]) < 1e-12);
  CHECK(fabs(frame[11] - 1) < 1e-12);
  for (int a = 1; a < 4; ++a) {
    for (int b = 1; b < 4; ++b) {
      double dot = 0;
      for (int k = 0; k < 3; ++k) dot += frame[3 * a + k] * frame[3 * b + k];
      CHECK(fabs(dot - (a == b)) < 1e-12);
    }
  }
}

static void a_cut_gives_its_size_first_and_then_its_points(void) {
  const double at[3] = {0, 0, -7e-3}, up[3] = {0, 0, 2};
  uint64_t count = 0, again = 0;
  MUST(mvs_snapshot_section(snapshot, at, up, NULL, 0, &count));
  CHECK(count == 2 * 2 * FUNNEL_SEGMENTS); /* each triangle of one row gives a segment */
  double *points = malloc(3 * sizeof *points * count);
  if (!points) exit(2);
  MUST(mvs_snapshot_section(snapshot, at, up, points, count, &again));
  CHECK(again == count);
  for (uint64_t k = 0; k < count; ++k) CHECK(fabs(points[3 * k + 2] + 7e-3) < 1e-15);
  /* a normal of any length, also where its square is no double */
  for (int k = 0; k < 3; ++k) {
    const double along[3] = {0, 0, k == 0 ? 1e300 : k == 1 ? 1e-300 : 5e-324};
    MUST(mvs_snapshot_section(snapshot, at, along, NULL, 0, &again));
    CHECK(again == count);
  }
  points[3] = 42;
  /* no more points than the buffer holds */
  MUST(mvs_snapshot_section(snapshot, at, up, points, 1, &again));
  CHECK(again == count && points[3] == 42);
  free(points);
}

static void a_valve_does_not_differ_from_itself(void) {
  mvs_comparison c = {.struct_size = sizeof c};
  MUST(mvs_snapshot_compare(snapshot, snapshot, &c));
  CHECK(c.same_mesh == 1);
  CHECK(c.node_max == 0 && c.surface_max < 1e-12); /* distance of a point to its own triangle */
  CHECK(fabs(c.registration[0] - 1) < 1e-9 && fabs(c.registration[3]) < 1e-12);
}

int main(void) {
  mvs_sim *sim = NULL;
  make_funnel(&f);
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_set_valve(sim, &f.desc));
  MUST(mvs_get_snapshot(sim, &snapshot));
  every_array_has_its_size_and_type();
  every_number_between_names_an_array_or_none();
  arrays_show_what_was_set();
  parts_are_found_by_index_and_name();
  measures_of_the_open_funnel();
  the_frame_points_into_the_atrium();
  a_cut_gives_its_size_first_and_then_its_points();
  a_valve_does_not_differ_from_itself();
  mvs_snapshot_release(snapshot);
  mvs_destroy(sim);
  return finish("views");
}
