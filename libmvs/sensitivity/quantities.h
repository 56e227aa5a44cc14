// Quantities to differentiate: their values and their gradients with respect to positions, and the
// dependence on parameters at fixed positions.
#pragma once

#include <mvs/sensitivity.h>

#include <vector>

#include "measure/orifice/orifice.h"
#include "sensitivity/parameters.h"
#include "sensitivity/tangent.h"

namespace mvs::core {

enum class QuantityKind : uint32_t {
  node_position = MVS_QUANTITY_NODE_POSITION,
  linear = MVS_QUANTITY_LINEAR,
  node_distance = MVS_QUANTITY_NODE_DISTANCE,
  chord_length = MVS_QUANTITY_CHORD_LENGTH,
  chord_strain = MVS_QUANTITY_CHORD_STRAIN,
  chord_tension = MVS_QUANTITY_CHORD_TENSION,
  head_force = MVS_QUANTITY_HEAD_FORCE,
  measure = MVS_QUANTITY_MEASURE
};

struct Quantity {
  QuantityKind kind = QuantityKind::linear;
  uint32_t index = 0, component = 0;
  const mvs_field_info *measure = nullptr;
  Vec3 point = Vec3::Zero();
  std::vector<Vec3> weights;
  const Orifice *orifice = nullptr;  // of this state, if it is known: it takes as long as a closure
};

// Throws MVS_E_ARGUMENT, with the place of the quantity in its list, unless the valve has it and it
// has a derivative.
void check_quantity(const Model &model, const Quantity &quantity, size_t place);

// Returns the field of mvs_measures with this name; throws MVS_E_ARGUMENT with the names that have
// derivatives.
const mvs_field_info *find_measure(const char *name, size_t place);

// A share of a chord in a quantity.
struct ChordShare {
  uint32_t chord;
  double factor;
};

// The gradient with respect to the end b of a chord alone.
struct ChordEnd {
  uint32_t chord;
  Vec3 by_b;
};

// dq = by_position dx + sum of factors times the changes of tension and strain at fixed positions.
struct QuantityGradient {
  double value = 0;
  bool by_differences = false;  // the gradient is not known: see MeasureDifferences
  NodeField by_position;
  std::vector<ChordShare> tension, strain;
  std::vector<ChordEnd> by_end;  // part of by_position, for ends that leave their nodes
  mvs_sensitivity_notes notes = 0;
};
// `slack`, m: motions within which another place takes over a largest value. `sheet`, nullable: a
// hierarchy of the triangles at any positions, which saves one.
QuantityGradient quantity_gradient(const Model &model, const State &state, const Quantity &quantity,
                                   double slack = 0, const BvhTopology *sheet = nullptr);

// The derivative of a quantity at fixed positions.
double explicit_derivative(const Model &model, const std::vector<Vec3> &x,
                           const QuantityGradient &gradient, const Parameter &parameter);

}  // namespace mvs::core
