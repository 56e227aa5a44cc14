/* Finer and coarser mesh levels of a simulator's valve, and states mapped between them. */
#include <math.h>

#include "check.h"
#include "funnel.h"

static mvs_sim *sim;

static const mvs_snapshot *present(mvs_sim *of) {
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_get_snapshot(of, &snapshot));
  return snapshot;
}

static mvs_view view(const mvs_snapshot *snapshot, uint32_t which) {
  mvs_view found = {0};
  MUST(mvs_snapshot_get_array(snapshot, which, &found));
  return found;
}

static void start(void) {
  mvs_parametric_desc desc = {0};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = 300;
  MUST(mvs_generate_valve(sim, &desc));
}

static mvs_result coarsen(uint32_t vertices, double edge, mvs_coarsening *made) {
  mvs_coarsen_options options = {sizeof options, vertices, edge};
  return mvs_coarsen_valve(sim, &options, made);
}

static void refining_keeps_old_nodes_and_tells_new_ones(void) {
  start();
  const mvs_snapshot *before = present(sim);
  MUST(mvs_refine_valve(sim));
  const mvs_snapshot *after = present(sim);
  mvs_view old = view(before, MVS_ARRAY_NODE_POSITION), made = view(after, MVS_ARRAY_NODE_POSITION);
  const uint32_t *origin = view(after, MVS_ARRAY_NODE_ORIGIN).data;
  CHECK(view(after, MVS_ARRAY_TRIANGLE_NODES).count ==
        4 * view(before, MVS_ARRAY_TRIANGLE_NODES).count);
  CHECK(same_bits(old.data, made.data, old.count * 3 * sizeof(double)));
  for (uint64_t n = 0; n < made.count; ++n) {
    CHECK(origin[n] == (n < old.count ? (uint32_t)n : UINT32_MAX));
  }
  mvs_snapshot_release(before);
  mvs_snapshot_release(after);
}

static void coarsening_says_what_it_did_and_where_nodes_are_from(void) {
  start();
  const mvs_snapshot *fine = present(sim);
  mvs_coarsening made = {0};
  made.struct_size = sizeof made;
  MUST(coarsen(150, 0, &made));
  CHECK(made.vertices == 150 && made.vertices_before > 270 && made.worst_quality > 0.2);
  CHECK(made.surface_max > made.surface_rms && made.surface_rms > 0);
  const mvs_snapshot *coarse = present(sim);
  mvs_view rest = view(coarse, MVS_ARRAY_NODE_REST), origin = view(coarse, MVS_ARRAY_NODE_ORIGIN);
  const double *fine_rest = view(fine, MVS_ARRAY_NODE_REST).data;
  for (uint64_t n = 0; n < rest.count; ++n) {
    const uint32_t from = ((const uint32_t *)origin.data)[n];
    CHECK(same_bits((const double *)rest.data + 3 * n, fine_rest + (size_t)3 * from,
                    3 * sizeof(double)));
  }
  mvs_snapshot_release(fine);
  mvs_snapshot_release(coarse);
}

static void a_length_of_edges_does_as_well(void) {
  start();
  mvs_coarsening made = {0};
  made.struct_size = sizeof made;
  MUST(coarsen(0, 3.5e-3, &made));
  CHECK(made.vertices > 80 && made.vertices < 200);
}

static void a_closed_valve_goes_over_to_a_finer_level(void) {
  mvs_load_case load = {sizeof load, 0, MVS_SYSTOLE_PA, 1}, carried = {0};
  mvs_stats stats = {0};
  carried.struct_size = stats.struct_size = sizeof load;
  stats.struct_size = sizeof stats;
  start();
  MUST(mvs_refine_valve(sim));
  const mvs_snapshot *open_fine = present(sim);
  MUST(coarsen(150, 0, NULL));
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_settle(sim, NULL, &stats));
  CHECK(stats.converged);
  const mvs_snapshot *closed = present(sim);
  hash128 coarse_hash = snapshot_hash(closed);

  MUST(mvs_restore(sim, open_fine));
  MUST(mvs_transfer_state(sim, closed));
  MUST(mvs_get_load(sim, &carried));
  CHECK(carried.pressure == load.pressure && carried.boundary_fraction == 1);
  MUST_FAIL(mvs_undo(sim), MVS_E_STATE, "undo");
  const mvs_snapshot *carried_over = present(sim);
  mvs_comparison distance = {0};
  distance.struct_size = sizeof distance;
  MUST(mvs_snapshot_compare(carried_over, closed, &distance));
  /* the distance of the two surfaces at rest, with edges of 3.5 mm */
  CHECK(distance.surface_rms < 0.3e-3);
  MUST(mvs_restore(sim, closed));
  MUST(mvs_transfer_state(sim, carried_over));
  CHECK(same_hash(coarse_hash, sim_hash(sim)));
  mvs_snapshot_release(open_fine);
  mvs_snapshot_release(closed);
  mvs_snapshot_release(carried_over);
}

static void what_cannot_be_done_changes_nothing_and_says_why(void) {
  funnel other;
  start();
  const mvs_snapshot *one = present(sim);
  hash128 before = sim_hash(sim);
  MUST_FAIL(coarsen(0, 0, NULL), MVS_E_ARGUMENT, "vertices or edge");
  MUST_FAIL(coarsen(200, 1e-3, NULL), MVS_E_ARGUMENT, "vertices or edge");
  MUST_FAIL(coarsen(0, NAN, NULL), MVS_E_ARGUMENT, "edge");
  MUST_FAIL(coarsen(0, 1.0, NULL), MVS_E_ARGUMENT, "edge");
  MUST_FAIL(coarsen(1000000, 0, NULL), MVS_E_ARGUMENT, "refine");
  MUST_FAIL(coarsen(3, 0, NULL), MVS_E_ARGUMENT, "too few");
  MUST_FAIL(mvs_coarsen_valve(sim, NULL, NULL), MVS_E_ARGUMENT, "options");
  MUST_FAIL(mvs_coarsen_valve(NULL, NULL, NULL), MVS_E_ARGUMENT, "sim");
  MUST_FAIL(mvs_refine_valve(NULL), MVS_E_ARGUMENT, "sim");
  MUST_FAIL(mvs_transfer_state(sim, NULL), MVS_E_ARGUMENT, "from");
  CHECK(same_hash(before, sim_hash(sim)));
  make_funnel(&other);
  MUST(mvs_set_valve(sim, &other.desc));
  before = sim_hash(sim);
  MUST_FAIL(mvs_transfer_state(sim, one), MVS_E_ARGUMENT, "levels");
  CHECK(same_hash(before, sim_hash(sim)));
  mvs_snapshot_release(one);
}

static void an_empty_simulator_has_no_levels(void) {
  mvs_sim *empty = NULL;
  mvs_coarsen_options options = {sizeof options, 100, 0};
  MUST(mvs_create(NULL, &empty));
  MUST_FAIL(mvs_refine_valve(empty), MVS_E_STATE, "no valve");
  MUST_FAIL(mvs_coarsen_valve(empty, &options, NULL), MVS_E_STATE, "no valve");
  mvs_destroy(empty);
}

int main(void) {
  MUST(mvs_create(NULL, &sim));
  refining_keeps_old_nodes_and_tells_new_ones();
  coarsening_says_what_it_did_and_where_nodes_are_from();
  a_length_of_edges_does_as_well();
  a_closed_valve_goes_over_to_a_finer_level();
  what_cannot_be_done_changes_nothing_and_says_why();
  an_empty_simulator_has_no_levels();
  mvs_destroy(sim);
  return finish("levels");
}
