// Gradients of positions, chordae, head forces and measures.
#include "sensitivity/quantities.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "measure/fields.h"
#include "model/sides.h"
#include "sensitivity/chord_site.h"
#include "sensitivity/chord_state.h"
#include "sensitivity/coaptation_gradient.h"
#include "sensitivity/orifice_gradient.h"
#include "sensitivity/settings.h"

namespace mvs::core {
namespace {

bool is_named(const mvs_field_info &field, const char *name) {
  return std::strcmp(field.name, name) == 0;
}

// Returns whether a measure is taken on a raster.
bool is_on_raster(const mvs_field_info &field) {
  return is_named(field, "tenting_volume") || is_named(field, "tenting_area") ||
         is_named(field, "billow_volume");
}

// Returns whether a measure of the annulus is that of its highest and lowest nodes, or of places
// half way along it, which are at a node of a symmetric valve.
bool has_places_of_annulus(const mvs_field_info &field) {
  return is_named(field, "annulus_saddle_height") || is_named(field, "annulus_ap") ||
         is_named(field, "annulus_nonplanar_angle");
}

// A gradient with respect to the end b of a chord; that of the end a is opposite.
void add_at_ends(const Model &model, uint32_t index, const Vec3 &by_b, QuantityGradient &q) {
  const Chord &chord = model.valve.chords[index];
  q.by_position[chord.a] -= by_b;
  q.by_position[chord.b] += by_b;
  q.by_end.push_back({index, by_b});
}

void add_length(const Model &model, uint32_t index, const ChordState &at, double times,
                QuantityGradient &q) {
  add_at_ends(model, index, times * at.along, q);
}

void add_tension(const Model &model, uint32_t index, const std::vector<Vec3> &x, double times,
                 QuantityGradient &q) {
  const ChordState at = chord_state(model, index, x);
  const Chord &chord = model.valve.chords[index];
  add_length(model, index, at, times * chord.area * at.response.slope / chord.rest_length, q);
  q.tension.push_back({index, times});
}

// q = direction . sum of tension times unit vector from the head.
void head_force(const Model &model, const Quantity &quantity, const std::vector<Vec3> &x,
                QuantityGradient &q) {
  const uint32_t node = model.valve.heads[quantity.index].node;
  const Rows &rows = model.topology.node_chords;
  const auto for_each_chord = [&](auto use) {
    for (uint32_t i = rows.start[node]; i < rows.start[node + 1]; ++i) {
      const uint32_t c = rows.items[i];
      const ChordState at = chord_state(model, c, x);
      const double sign = model.valve.chords[c].a == node ? 1 : -1;
      use(c, at, Vec3(sign * at.along), model.valve.chords[c].area * at.response.stress);
    }
  };
  Vec3 force = Vec3::Zero();
  for_each_chord([&](uint32_t, const ChordState &, const Vec3 &away, double tension) {
    force += tension * away;
  });
  Vec3 direction = Vec3::Zero();
  if (quantity.component < 3) {
    direction[static_cast<int>(quantity.component)] = 1;
  } else if (force.norm() > 0) {
    direction = force.normalized();
  }
  q.value = direction.dot(force);
  for_each_chord([&](uint32_t c, const ChordState &at, const Vec3 &away, double tension) {
    add_tension(model, c, x, direction.dot(away), q);
    const Vec3 turn = (tension / at.length) * (direction - direction.dot(away) * away);
    add_at_ends(model, c, model.valve.chords[c].a == node ? turn : Vec3(-turn), q);
  });
}

void leaflet_area(const Model &model, const std::vector<Vec3> &x, QuantityGradient &q) {
  for (const Tri &t : model.valve.triangles) {
    const Vec3 twice = area_normal(x, t);
    const double size = twice.norm();
    q.value += 0.5 * size;
    if (size == 0) continue;
    for (int k = 0; k < 3; ++k) {
      const Vec3 opposite = x[t[(k + 2) % 3]] - x[t[(k + 1) % 3]];
      q.by_position[t[k]] += 0.5 / size * twice.cross(opposite);
    }
  }
}

// The first chord with the largest strain or tension. It is tied where another one reaches it when
// the ends of both move by `slack`.
void largest_of_chords(const Model &model, const std::vector<Vec3> &x, bool is_tension,
                       double slack, QuantityGradient &q) {
  q.notes |= MVS_SENSITIVITY_NOTE_EXTREME;
  uint32_t largest = none;
  double others_reach = 0;
  double largest_falls_to = 0;
  for (uint32_t c = 0; c < model.valve.chords.size(); ++c) {
    const Chord &chord = model.valve.chords[c];
    if (chord.kind == ChordKind::suture) continue;
    const ChordState at = chord_state(model, c, x);
    const double value = is_tension ? chord.area * at.response.stress : at.strain;
    const double slope = (is_tension ? chord.area * at.response.slope : 1) / chord.rest_length;
    const double change = 2 * slack * slope;
    if (value <= q.value) {
      others_reach = std::max(others_reach, value + change);
      continue;
    }
    if (largest != none) others_reach = std::max(others_reach, 2 * q.value - largest_falls_to);
    q.value = value;
    largest_falls_to = value - change;
    largest = c;
  }
  if (largest == none) return;
  if (others_reach > largest_falls_to) q.notes |= MVS_SENSITIVITY_NOTE_TIED;
  if (is_tension) {
    add_tension(model, largest, x, 1, q);
  } else {
    const ChordState at = chord_state(model, largest, x);
    add_length(model, largest, at, 1 / model.valve.chords[largest].rest_length, q);
    q.strain.push_back({largest, 1});
  }
}

void measure(const Model &model, const State &state, const Quantity &quantity, double slack,
             const BvhTopology *sheet, QuantityGradient &q) {
  const mvs_field_info &field = *quantity.measure;
  if (is_named(field, "leaflet_area")) return leaflet_area(model, state.x, q);
  if (is_named(field, "max_chord_tension"))
    return largest_of_chords(model, state.x, true, slack, q);
  if (is_named(field, "max_chord_strain"))
    return largest_of_chords(model, state.x, false, slack, q);
  if (is_named(field, "coaptation_area")) {
    q.value = coaptation_area_gradient(model, state.x, q.by_position);
    return;
  }
  if (is_named(field, "regurgitant_orifice_area")) {
    const Orifice measured =
        quantity.orifice != nullptr ? Orifice() : measure_orifice(model, state.x);
    const Orifice &orifice = quantity.orifice != nullptr ? *quantity.orifice : measured;
    q.value = orifice_area_gradient(model, state.x, orifice, sheet, q.by_position);
    q.notes |= MVS_SENSITIVITY_NOTE_ENVELOPE;
    return;
  }
  q.by_differences = true;
  q.notes |= MVS_SENSITIVITY_NOTE_DIFFERENCES;
  if (is_on_raster(field)) {
    q.notes |= MVS_SENSITIVITY_NOTE_RASTER;
  } else if (field.group != MVS_MEASURE_GROUP_ANNULUS || has_places_of_annulus(field)) {
    q.notes |= MVS_SENSITIVITY_NOTE_EXTREME;
  }
  q.value = measure_field(model, state.x, field);
}

}  // namespace

QuantityGradient quantity_gradient(const Model &model, const State &state, const Quantity &quantity,
                                   double slack, const BvhTopology *sheet) {
  const std::vector<Vec3> &x = state.x;
  QuantityGradient q;
  q.by_position.assign(x.size(), Vec3::Zero());
  const uint32_t index = quantity.index;
  switch (quantity.kind) {
    case QuantityKind::node_position: {
      const auto axis = static_cast<int>(quantity.component);
      q.value = x[index][axis];
      q.by_position[index][axis] = 1;
      break;
    }
    case QuantityKind::linear:
      for (size_t i = 0; i < quantity.weights.size(); ++i) {
        q.value += quantity.weights[i].dot(x[i]);
        q.by_position[i] = quantity.weights[i];
      }
      break;
    case QuantityKind::node_distance: {
      const Vec3 away = x[index] - quantity.point;
      q.value = away.norm();
      if (q.value > 0) q.by_position[index] = away / q.value;
      break;
    }
    case QuantityKind::chord_length:
    case QuantityKind::chord_strain: {
      const ChordState at = chord_state(model, index, x);
      const bool is_strain = quantity.kind == QuantityKind::chord_strain;
      q.value = is_strain ? at.strain : at.length;
      add_length(model, index, at, is_strain ? 1 / model.valve.chords[index].rest_length : 1.0, q);
      if (is_strain) q.strain.push_back({index, 1});
      break;
    }
    case QuantityKind::chord_tension:
      q.value = model.valve.chords[index].area * chord_state(model, index, x).response.stress;
      add_tension(model, index, x, 1, q);
      break;
    case QuantityKind::head_force:
      head_force(model, quantity, x, q);
      break;
    case QuantityKind::measure:
      measure(model, state, quantity, slack, sheet, q);
      break;
  }
  return q;
}

double explicit_derivative(const Model &model, const std::vector<Vec3> &x,
                           const QuantityGradient &gradient, const Parameter &parameter) {
  double sum = 0;
  if (parameter.kind == ParameterKind::chord_site) {
    const ChordSite site = chord_site(model, parameter);
    const Vec3 motion = site_direction(site, x);
    for (const ChordEnd &end : gradient.by_end) {
      if (end.chord != site.chord) continue;
      sum += (model.valve.chords[end.chord].b == site.node ? 1 : -1) * end.by_b.dot(motion);
    }
    return sum;
  }
  for (const ChordShare &share : gradient.tension) {
    sum += share.factor * tension_derivative(model, share.chord, x, parameter);
  }
  if (parameter.kind != ParameterKind::chord_rest_length) return sum;
  for (const ChordShare &share : gradient.strain) {
    if (share.chord != parameter.index) continue;
    const double rest = model.valve.chords[share.chord].rest_length;
    sum -= share.factor * chord_state(model, share.chord, x).length / (rest * rest);
  }
  return sum;
}

}  // namespace mvs::core
