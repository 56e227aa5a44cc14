/* Cost of a repair: area and gradient of the open valve, leaflet lengths, risk of SAM, pull on
 * the annulus. */
#include <math.h>
#include <mvs/mvs.h>

#include "tests/api/check.h"
#include "tests/api/funnel.h"

static const double turn = 2 * 3.14159265358979323846;

static mvs_cost cost_of(const mvs_snapshot *snapshot, const mvs_cost_options *options) {
  mvs_cost cost = {.struct_size = sizeof cost};
  MUST(mvs_snapshot_measure_cost(snapshot, options, &cost, NULL));
  return cost;
}

/* The default valve, with a ring unless `ring` is 0, closed under systole. */
static const mvs_snapshot *closed_valve(double ring) {
  mvs_sim *sim;
  const mvs_snapshot *closed = NULL;
  mvs_load_case load = {sizeof load, 0, MVS_SYSTOLE_PA, 1};
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, NULL));
  if (ring > 0) {
    mvs_op_ring op = {.op = {sizeof op, MVS_OP_RING}, .size = ring};
    MUST(mvs_apply_op(sim, &op.op, NULL));
  }
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_settle(sim, NULL, NULL));
  MUST(mvs_get_snapshot(sim, &closed));
  mvs_destroy(sim);
  return closed;
}

static mvs_view view_of(const mvs_snapshot *snapshot, mvs_array_kind which) {
  mvs_view view = {0};
  MUST(mvs_snapshot_get_array(snapshot, which, &view));
  return view;
}

/* A funnel that 20 Pa hardly move: the polygon of its lower rim, and the length of its wall. */
static void a_rigid_funnel_is_open_as_wide_as_its_rim(void) {
  funnel f;
  mvs_sim *sim;
  const mvs_snapshot *snapshot;
  make_funnel(&f);
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_set_valve(sim, &f.desc));
  MUST(mvs_get_snapshot(sim, &snapshot));
  mvs_cost_options options = {.struct_size = sizeof options, .pressure = 20};
  const mvs_cost cost = cost_of(snapshot, &options);
  const double rim = FUNNEL_SEGMENTS / 2.0 * 9e-3 * 9e-3 * sin(turn / FUNNEL_SEGMENTS);
  const double wall = 3 * sqrt(2e-3 * 2e-3 + 6e-3 * 6e-3);
  CHECK(cost.opened == 1);
  CHECK(fabs(cost.open_area / rim - 1) < 0.01); /* as the issue asks */
  CHECK(fabs(cost.anterior_height - wall) < 1e-9);
  CHECK(fabs(cost.posterior_height - wall) < 1e-9);
  CHECK(isnan(cost.anterior_length) && isnan(cost.length_ratio)); /* it has no coaptation */
  CHECK(isnan(cost.gradient));
  mvs_snapshot_release(snapshot);
  mvs_destroy(sim);
}

static void a_larger_ring_opens_wider_and_lowers_the_gradient(void) {
  mvs_cost_options options = {.struct_size = sizeof options, .flow = 250e-6};
  double area = 0, gradient = INFINITY;
  /* 35 mm: the annulus; the leaflets bound the area within a larger ring */
  const double sizes[] = {26e-3, 30e-3, 34e-3};
  for (int k = 0; k < 3; ++k) {
    const mvs_snapshot *closed = closed_valve(sizes[k]);
    const mvs_cost cost = cost_of(closed, &options);
    const double speed = options.flow / (0.85 * cost.open_area);
    CHECK(cost.opened == 1 && cost.rings == 1);
    CHECK(cost.open_area > area && cost.gradient < gradient);
    CHECK(fabs(cost.gradient / (0.5 * 1060 * speed * speed) - 1) < 1e-12);
    area = cost.open_area;
    gradient = cost.gradient;
    mvs_snapshot_release(closed);
  }
}

static void the_open_valve_has_the_bits_of_a_settle(void) {
  const mvs_snapshot *closed = closed_valve(0), *opened = NULL, *by_hand = NULL;
  mvs_cost cost = {.struct_size = sizeof cost};
  mvs_sim *sim;
  mvs_load_case load = {sizeof load, 0, -MVS_DIASTOLE_PA, 0};
  uint64_t before[2], after[2], one[2], other[2];
  MUST(mvs_snapshot_get_hash(closed, before));
  MUST(mvs_snapshot_measure_cost(closed, NULL, &cost, &opened));
  MUST(mvs_snapshot_get_hash(closed, after));
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_restore(sim, closed));
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_settle(sim, NULL, NULL));
  MUST(mvs_get_snapshot(sim, &by_hand));
  MUST(mvs_snapshot_get_hash(opened, one));
  MUST(mvs_snapshot_get_hash(by_hand, other));
  CHECK(memcmp(before, after, sizeof before) == 0);
  CHECK(memcmp(one, other, sizeof one) == 0);
  mvs_measures measures = {.struct_size = sizeof measures};
  MUST(mvs_snapshot_measure(opened, &measures));
  CHECK(measures.regurgitant_orifice_area == cost.open_area);
  mvs_snapshot_release(closed);
  mvs_snapshot_release(opened);
  mvs_snapshot_release(by_hand);
  mvs_destroy(sim);
}

/* In equilibrium annulus and heads hold the pressure on the leaflets. */
static void annulus_and_heads_hold_the_pressure(void) {
  const mvs_snapshot *closed = closed_valve(30e-3);
  const mvs_view pull = view_of(closed, MVS_ARRAY_ANNULUS_FORCE);
  const mvs_view head = view_of(closed, MVS_ARRAY_HEAD_FORCE);
  const mvs_view node = view_of(closed, MVS_ARRAY_NODE_POSITION);
  const mvs_view triangle = view_of(closed, MVS_ARRAY_TRIANGLE_NODES);
  const mvs_cost cost = cost_of(closed, NULL);
  double held[3] = {0}, sum = 0, most = 0;
  for (uint64_t k = 0; k < pull.count; ++k) {
    const double *force = (const double *)pull.data + 3 * k;
    const double size = sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]);
    for (int c = 0; c < 3; ++c) held[c] += force[c];
    sum += size;
    most = fmax(most, size);
  }
  for (uint64_t k = 0; k < 3 * head.count; ++k) held[k % 3] += ((const double *)head.data)[k];
  for (uint64_t t = 0; t < triangle.count; ++t) {
    const uint32_t *corner = (const uint32_t *)triangle.data + 3 * t;
    double u[3], v[3];
    for (int c = 0; c < 3; ++c) {
      const double from = ((const double *)node.data)[3 * corner[0] + c];
      u[c] = ((const double *)node.data)[3 * corner[1] + c] - from;
      v[c] = ((const double *)node.data)[3 * corner[2] + c] - from;
    }
    for (int c = 0; c < 3; ++c) {
      const int i = (c + 1) % 3, j = (c + 2) % 3;
      held[c] -= 0.5 * MVS_SYSTOLE_PA * (u[i] * v[j] - u[j] * v[i]);
    }
  }
  /* every one of some 400 free nodes may be out of balance by the residual, 1e-5 N */
  for (int c = 0; c < 3; ++c) CHECK(fabs(held[c]) < 400 * 1e-5);
  CHECK(fabs(sum / cost.annulus_force_sum - 1) < 1e-12);
  CHECK(most == cost.annulus_force_max && most > 0.01);
  CHECK(cost.rings == 1);
  mvs_snapshot_release(closed);
}

/* Points on a wall at a distance beside the coaptation, towards the anterior leaflet. */
static void sam_needs_points_of_the_septum(void) {
  const mvs_snapshot *closed = closed_valve(0);
  double frame[12], septum[2][3];
  mvs_cost_options options = {.struct_size = sizeof options};
  const mvs_cost blind = cost_of(closed, &options);
  CHECK(blind.sam_risk == MVS_SAM_NOT_DETERMINED && isnan(blind.septal_distance));
  CHECK(blind.length_ratio > 1 && blind.anterior_length < blind.anterior_height * 1.3);
  MUST(mvs_snapshot_get_frame(closed, frame));
  options.septum = packed(septum, 2, 3, MVS_TYPE_F64);
  for (int near = 0; near < 2; ++near) {
    for (int c = 0; c < 3; ++c) {
      septum[0][c] = frame[c] + (near ? 5e-3 : 60e-3) * frame[3 + c] - 10e-3 * frame[9 + c];
      septum[1][c] = frame[c] + 1.0 * frame[3 + c];
    }
    const mvs_cost cost = cost_of(closed, &options);
    const int raised = near || cost.length_ratio <= 1.3;
    CHECK(cost.sam_risk == (raised ? MVS_SAM_RAISED : MVS_SAM_LOW));
    CHECK(near == (cost.septal_distance <= 25e-3));
  }
  /* an open valve has no coaptation, so no verdict */
  const mvs_snapshot *opened = NULL;
  mvs_cost cost = {.struct_size = sizeof cost};
  MUST(mvs_snapshot_measure_cost(closed, &options, &cost, &opened));
  CHECK(cost_of(opened, &options).sam_risk == MVS_SAM_NOT_DETERMINED);
  mvs_snapshot_release(opened);
  mvs_snapshot_release(closed);
}

static int32_t cancel(void *user, double share, double residual) {
  (void)user;
  (void)share;
  (void)residual;
  return 1;
}

static void bad_input_changes_nothing(void) {
  const mvs_snapshot *closed = closed_valve(0), *opened = NULL;
  mvs_cost cost = {.struct_size = sizeof cost, .rings = 77};
  const float septum[2] = {0, 0};
  mvs_cost_options pressure = {.struct_size = sizeof pressure, .pressure = -666};
  mvs_cost_options discharge = {.struct_size = sizeof discharge, .discharge = 2};
  mvs_cost_options points = {.struct_size = sizeof points,
                             .septum = packed(septum, 1, 2, MVS_TYPE_F32)};
  mvs_cost_options stop = {.struct_size = sizeof stop, .progress = cancel};
  MUST_FAIL(mvs_snapshot_measure_cost(closed, &pressure, &cost, &opened), MVS_E_ARGUMENT,
            "options.pressure");
  MUST_FAIL(mvs_snapshot_measure_cost(closed, &discharge, &cost, &opened), MVS_E_ARGUMENT,
            "options.discharge");
  MUST_FAIL(mvs_snapshot_measure_cost(closed, &points, &cost, &opened), MVS_E_ARGUMENT,
            "options.septum");
  /* millimetres taken for metres, and the other way round */
  const double far[2][3] = {{20, 0, -10}, {25, 0, -10}}, tiny[2][3] = {{2e-5, 0, 0}, {3e-5, 0, 0}};
  points.septum = packed(far, 2, 3, MVS_TYPE_F64);
  MUST_FAIL(mvs_snapshot_measure_cost(closed, &points, &cost, &opened), MVS_E_ARGUMENT,
            "options.septum");
  points.septum = packed(tiny, 2, 3, MVS_TYPE_F64);
  MUST_FAIL(mvs_snapshot_measure_cost(closed, &points, &cost, &opened), MVS_E_ARGUMENT,
            "options.septum");
  /* points on the side of the posterior leaflet, as of another frame */
  double frame[12], behind[2][3];
  MUST(mvs_snapshot_get_frame(closed, frame));
  for (int k = 0; k < 2; ++k) {
    for (int c = 0; c < 3; ++c) {
      behind[k][c] = frame[c] - 40e-3 * frame[3 + c] - (10 + 5 * k) * 1e-3 * frame[9 + c];
    }
  }
  points.septum = packed(behind, 2, 3, MVS_TYPE_F64);
  MUST_FAIL(mvs_snapshot_measure_cost(closed, &points, &cost, &opened), MVS_E_ARGUMENT,
            "on the side of the posterior leaflet");
  /* mmHg taken for Pa; l/s taken for ml/s and for m3/s; just beyond the limits */
  pressure.pressure = 5;
  MUST_FAIL(mvs_snapshot_measure_cost(closed, &pressure, &cost, &opened), MVS_E_ARGUMENT,
            "looks like mmHg or kPa given as Pa");
  static const double flows[] = {0.25, 0.25e-6, 0.999 * MVS_FLOW_MIN, 1.001 * MVS_FLOW_MAX};
  for (int k = 0; k < 4; ++k) {
    const mvs_cost_options flow = {.struct_size = sizeof flow, .flow = flows[k]};
    MUST_FAIL(mvs_snapshot_measure_cost(closed, &flow, &cost, &opened), MVS_E_ARGUMENT,
              "give it in m3/s");
  }
  const double broken[2][3] = {{20e-3, 0, -10e-3}, {20e-3, NAN, -10e-3}};
  points.septum = packed(broken, 2, 3, MVS_TYPE_F64);
  MUST_FAIL(mvs_snapshot_measure_cost(closed, &points, &cost, &opened), MVS_E_ARGUMENT,
            "point 1 is");
  MUST_FAIL(mvs_snapshot_measure_cost(closed, &stop, &cost, &opened), MVS_E_CANCELLED, "");
  MUST_FAIL(mvs_snapshot_measure_cost(NULL, NULL, &cost, NULL), MVS_E_ARGUMENT, "snapshot");
  CHECK(cost.rings == 77 && opened == NULL);
  mvs_snapshot_release(closed);
}

int main(void) {
  a_rigid_funnel_is_open_as_wide_as_its_rim();
  a_larger_ring_opens_wider_and_lowers_the_gradient();
  the_open_valve_has_the_bits_of_a_settle();
  annulus_and_heads_hold_the_pressure();
  sam_needs_points_of_the_septum();
  bad_input_changes_nothing();
  return finish("cost");
}
