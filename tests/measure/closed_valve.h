// A closed parametric valve and smooth motions of it.
#pragma once

#include <mvs/sim.h>

#include <cmath>

#include "anatomy/parametric.h"
#include "solve/solver.h"
#include "tests/measure/shapes.h"

namespace mvs::core::test {

struct Shape {
  ModelPtr model;
  std::vector<Vec3> x;
};

// A smooth field of vectors up to about 2, without any symmetry of the valve.
inline Vec3 smooth_field(const Vec3 &p, double wave, int number) {
  const double n = number;
  const Vec3 q = wave * p + Vec3(0.3 * n, 0.7 * n, 1.1 * n);
  return Vec3(std::sin(q[1] + 1.3 * n), std::sin(q[2] + 2.1 * n), std::sin(q[0] + 0.7 * n)) +
         30 * Vec3(p[0] + 0.5 * p[1], p[1] - 0.3 * p[0], p[2] + 0.2 * p[0]);
}

// A parametric valve closed under 120 mmHg; 0 vertices: the default.
inline Shape settled_valve(double annulus_scale, uint32_t vertices, mvs_shape valve_shape) {
  mvs_parametric_desc desc{};
  desc.struct_size = sizeof desc;
  desc.annulus_scale = annulus_scale;
  desc.vertices = vertices;
  desc.shape = valve_shape;
  Shape shape;
  shape.model = make_model(make_parametric_valve(desc));
  State state = initial_state(*shape.model);
  state.load = {120 * 133.322, 1};
  Solver(Backend::fastest).settle(*shape.model, state, {}, nullptr);
  shape.x = state.x;
  return shape;
}

// The same, moved by up to 0.1 mm: the symmetry of the parametric valve makes kinks, as both halves
// are equally high.
inline Shape closed_valve(double annulus_scale, uint32_t vertices = 0,
                          mvs_shape valve_shape = MVS_SHAPE_HEALTHY) {
  Shape shape = settled_valve(annulus_scale, vertices, valve_shape);
  shape.x =
      moved(shape.x, [](const Vec3 &p) -> Vec3 { return p + 5e-5 * smooth_field(p, 150, 11); });
  return shape;
}

}  // namespace mvs::core::test
