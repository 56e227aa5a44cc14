// Parameters of model and load: their checks, their changes, and the derivative of the gradient of
// the energy with respect to them.
//
// The derivative is analytic for rest lengths, moduli, areas and sites of chordae, pressure and
// positions. For constants and thickness of leaflets and for prestrain it is a central difference
// of fourth order of the elastic terms at fixed positions: exact for thickness, with a relative
// error of about 1e-10 for the others (tests/sensitivity/cable_and_cylinder.cpp).
#pragma once

#include <mvs/sensitivity.h>

#include <span>
#include <vector>

#include "model/model.h"

namespace mvs::core {

enum class ParameterKind : uint32_t {
  chord_rest_length = MVS_PARAMETER_CHORD_REST_LENGTH,
  chord_young = MVS_PARAMETER_CHORD_YOUNG,
  chord_area = MVS_PARAMETER_CHORD_AREA,
  leaflet_constant = MVS_PARAMETER_LEAFLET_CONSTANT,
  leaflet_thickness = MVS_PARAMETER_LEAFLET_THICKNESS,
  scallop_constant = MVS_PARAMETER_SCALLOP_CONSTANT,
  scallop_thickness = MVS_PARAMETER_SCALLOP_THICKNESS,
  prestrain = MVS_PARAMETER_PRESTRAIN,
  pressure = MVS_PARAMETER_PRESSURE,
  node_position = MVS_PARAMETER_NODE_POSITION,
  head_position = MVS_PARAMETER_HEAD_POSITION,
  annulus_scale = MVS_PARAMETER_ANNULUS_SCALE,
  boundary_mode = MVS_PARAMETER_BOUNDARY_MODE,
  chord_site = MVS_PARAMETER_CHORD_SITE
};

struct Parameter {
  ParameterKind kind = ParameterKind::pressure;
  uint32_t index = 0, component = 0;
  std::vector<Vec3> mode;  // m, one a node: of a boundary mode
};

bool is_of_chord(ParameterKind kind);
// The leaflet of a parameter of tissue.
uint32_t leaflet_of_parameter(const Valve &valve, const Parameter &parameter);

// Throws MVS_E_ARGUMENT, with the place of the parameter in its list, unless the valve has it.
void check_parameter(const Model &model, const Parameter &parameter, size_t place);

// A vector at a node.
struct NodeVector {
  uint32_t node;
  Vec3 value;
};

// The derivative of dE/dx at fixed positions, and that of the positions of prescribed nodes.
struct ParameterLoad {
  std::vector<NodeVector> force;   // N over the unit of the parameter, of free nodes
  std::vector<NodeVector> motion;  // m over the unit, of prescribed nodes
};
ParameterLoad parameter_load(const Model &model, const State &state, const Parameter &parameter);

// A change of one parameter.
struct ParameterStep {
  const Parameter *parameter;
  double by;
};

// The model after changes; masses and the contact thickness keep their values. Pressure,
// positions and sites of chordae are not part of it.
Model changed_model(const Model &model, std::span<const ParameterStep> steps);
// Adds a multiple of dE/dx of the terms that parameters of the tissue change: the elastic ones of
// the leaflets, and contact, whose weights and ranges follow the rest shape, if that changes.
void add_tissue(const Model &model, bool rest_changes, double times, const std::vector<Vec3> &x,
                std::vector<Vec3> &g);
// Adds the change of dE/dx at fixed positions x, without that by the motion of prescribed nodes.
void add_change(const Model &model, std::span<const ParameterStep> steps,
                const std::vector<Vec3> &x, std::vector<Vec3> &g);

// A change of the parameter that is large for it: its value, 1 m for a position. Scales parameters
// of different units to each other.
double natural_scale(const Model &model, const State &state, const Parameter &parameter);

// The derivative of the tension of a chord at fixed positions, N over the unit of the parameter; 0
// unless it is a parameter of this chord.
double tension_derivative(const Model &model, uint32_t chord, const std::vector<Vec3> &x,
                          const Parameter &parameter);

}  // namespace mvs::core
