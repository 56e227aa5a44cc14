// Contact of the sheet with instruments that push: balls, and rods with round ends (capsules).
//
// Their points (the centre of a ball, the centres of both ends of a rod) are nodes like any other:
// the springs of the hand pull them (energy/grasp.h), the sheet pushes them, the step limiter
// shortens their steps. So the instrument that pushes is a proxy, as the god-object of Zilles &
// Salisbury (IROS 1995), that never passes through the sheet.
//
// Each vertex has the energy E_v = kappa A_v r B((d - R) / r), d the distance from the vertex to
// the centre or the axis, R the radius, r half of the contact thickness: a pressure at a distance,
// at any mesh size. A short-range barrier of the same B keeps triangles and edges out between
// vertices: for each end and triangle, and for each axis and edge. Its strength grows with the
// force limit of the hand (tool_barrier_strength), so that the hand presses no pair closer than a
// tenth of its range. While all of these distances are above R nothing passes through. An axial
// spring keeps the length of a rod. There is no friction, and chordae do not collide with balls and
// rods. convex_contact.h has convex tools.
#pragma once

#include <vector>

#include "collision/instrument_bodies.h"
#include "energy/barrier.h"
#include "energy/convex_contact.h"
#include "model/model.h"

namespace mvs::core {

class InstrumentTerm {
 public:
  explicit InstrumentTerm(const Model &model) : model_(&model), bodies_(model), convex_(model) {}

  InstrumentBodies &bodies() { return bodies_; }
  const InstrumentBodies &bodies() const { return bodies_; }
  bool empty() const { return bodies_.empty(); }

  void collect(const std::vector<Vec3> &x);
  const std::vector<ContactPair> &contact_pairs() const { return contact_pairs_; }
  const ConvexContactTerm &convex() const { return convex_; }

  // These refer to the last collect().
  double energy(const std::vector<Vec3> &x) const;
  double gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const;
  bool hessian(const std::vector<Vec3> &x, Curvature curvature, HessianAssembler &assembler) const;
  void add_pairs(std::vector<Edge> &pairs) const;

 private:
  void take_vertex(const std::vector<Vec3> &x, const InstrumentBody &body, uint32_t v);
  void take_triangle(const std::vector<Vec3> &x, const InstrumentBody &body, uint32_t t);
  void take_edge(const std::vector<Vec3> &x, const InstrumentBody &body, uint32_t e);
  void finish(const std::vector<Vec3> &x, const InstrumentBody &body, ContactPair s, double range,
              double area, bool is_barrier);

  const Model *model_;
  InstrumentBodies bodies_;
  std::vector<ContactPair> contact_pairs_;
  ConvexContactTerm convex_;
};

}  // namespace mvs::core
