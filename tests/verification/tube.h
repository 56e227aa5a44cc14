// A tube of tissue between two fixed ends, with circumferential fibres.
#pragma once

#include "tests/solve/bench.h"
#include "tests/verification/published.h"

namespace mvs::core::verification {

// One sheet of the law's tissue, without bending stiffness.
void make_tissue(Valve &valve, const Published &law);

struct TubeMesh {
  uint32_t around, rows;  // triangles' sides around; rows of triangles along
  double length;          // m
};
struct Tube {
  Model model;
  test::Positions straight;  // the closed form: the tube of the radius of its ends
};
// `stretch` times `radius`, the rest radius, is the radius to which load moves the ends, at
// constant length. Under the pressure of Laplace's law the whole tube is in equilibrium at that
// radius.
Tube tube_drawn_out(const Published &law, double radius, const TubeMesh &mesh, double stretch);

}  // namespace mvs::core::verification
