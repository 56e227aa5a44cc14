// The annulus, rings and papillary heads moved as far as the operations let them.
#include <cmath>

#include "tests/stability/case.h"

namespace stability {
namespace {

void scale_annulus(Watch &watch, double factor) {
  mvs_op_annulus_scale op = {};
  op.factor = factor;
  watch.operate(op, MVS_OP_ANNULUS_SCALE);
}

Case annulus_at_once(const std::string &name, double factor) {
  return {"boundary/" + name, [=](Watch &w) {
            scale_annulus(w, factor);
            w.rest();
          }};
}

// To a quarter in eight operations, each of which may converge or not.
void annulus_in_steps(Watch &watch) {
  for (int k = 0; k < 8; ++k) {
    scale_annulus(watch, std::pow(0.25, 1.0 / 8));
    watch.rest();
  }
}

void small_ring(Watch &watch) {
  mvs_op_ring op = {};
  op.size = 10e-3;
  watch.operate(op, MVS_OP_RING);
  watch.rest();
}

// A saddle turned over about the CC axis: its atrial side faces the ventricle.
void ring_upside_down(Watch &watch) {
  std::vector<double> curve, marks, marks_at;
  const auto frame = watch.sim().snapshot().frame();
  for (int k = 0; k < 64; ++k) {
    const double angle = 2 * M_PI * k / 64;
    const double local[3] = {13e-3 * std::cos(angle), 17e-3 * std::sin(angle),
                             -2.4e-3 * std::cos(2 * angle)};
    const double upright[3] = {local[0], local[1], -local[2]};
    curve.insert(curve.end(), upright, upright + 3);
    if (k % 16) continue;
    marks.insert(marks.end(), upright, upright + 3);
    for (int c = 0; c < 3; ++c) {
      double at = frame[c];
      for (int axis = 0; axis < 3; ++axis) {
        // half a turn about the CC axis
        const double sign = axis == 1 ? 1 : -1;
        at += sign * upright[axis] * frame[3 * (axis + 1) + c];
      }
      marks_at.push_back(at);
    }
  }
  mvs_op_ring op = {};
  op.curve = {curve.data(), curve.size() / 3, 3, MVS_TYPE_F64, 0};
  op.landmarks = {marks.data(), marks.size() / 3, 3, MVS_TYPE_F64, 0};
  op.landmarks_at = {marks_at.data(), marks_at.size() / 3, 3, MVS_TYPE_F64, 0};
  watch.operate(op, MVS_OP_RING);
  watch.rest();
}

// Every head by 20 mm along an axis of the valve, or away from the others.
Case heads(const std::string &name, int axis, double by) {
  return {"boundary/heads_20mm_" + name, [=](Watch &w) {
            double sign = 1;
            for (const mvs_part &head : w.sim().snapshot().parts(MVS_PART_HEAD)) {
              mvs_op_head_move op = {};
              op.head = head.id;
              op.by[axis] = axis == 1 ? sign * by : by;
              op.frame = 1;
              w.operate(op, MVS_OP_HEAD_MOVE);
              sign = -sign;
            }
            w.rest();
          }};
}

}  // namespace

std::vector<Case> boundary_cases() {
  return {annulus_at_once("annulus_25_at_once", 0.25),
          {"boundary/annulus_25_in_steps", annulus_in_steps},
          annulus_at_once("annulus_200", 2),
          {"boundary/ring_far_too_small", small_ring},
          {"boundary/ring_upside_down", ring_upside_down},
          heads("up", 2, 20e-3),
          heads("down", 2, -20e-3),
          heads("sideways", 0, 20e-3),
          heads("across", 1, 20e-3),
          heads("apart", 1, -20e-3)};
}

}  // namespace stability
