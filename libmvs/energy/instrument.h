// Instruments that push: balls, and rods with round ends, against the sheet.
//
// Their points (the middle of a ball, of both ends of a rod) are nodes like any other: led by the
// hand's springs (physics/grasp.h), pushed by the sheet, cut by the step bounds. So what pushes is
// a proxy, in the sense of Zilles & Salisbury's god-object (IROS 1995), that never passes through.
//
// The sheet feels an instrument through its vertices, E_v = kappa A_v r B((d - R) / r), d from the
// vertex to the middle or the axis, R the radius, r half of the contact thickness: a pressure at a
// distance, at any mesh size. Between vertices a guard keeps every triangle and edge out: the same
// barrier over a short range for each end and triangle, and for each axis and edge. All of these
// distances above R means that nothing crosses. An axial spring keeps a rod's length.
#pragma once

#include <vector>

#include "collision/instrument_bodies.h"
#include "energy/barrier.h"
#include "model/model.h"

namespace mvs::core {

class InstrumentTerm {
 public:
  explicit InstrumentTerm(const Model &model) : model_(&model), bodies_(model) {}

  InstrumentBodies &bodies() { return bodies_; }
  const InstrumentBodies &bodies() const { return bodies_; }
  bool empty() const { return bodies_.all().empty(); }

  void collect(const std::vector<Vec3> &x);
  const std::vector<ContactPair> &contact_pairs() const { return contact_pairs_; }

  // These speak of the last collect().
  double energy(const std::vector<Vec3> &x) const;
  double gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const;
  bool hessian(const std::vector<Vec3> &x, Curvature curvature, HessianAssembler &system) const;
  void add_pairs(std::vector<Edge> &pairs) const;

 private:
  void take_vertex(const std::vector<Vec3> &x, const InstrumentBody &body, uint32_t v);
  void take_triangle(const std::vector<Vec3> &x, const InstrumentBody &body, uint32_t t);
  void take_edge(const std::vector<Vec3> &x, const InstrumentBody &body, uint32_t e);
  void finish(const std::vector<Vec3> &x, const InstrumentBody &body, ContactPair s, double range,
              double area, bool guard);

  const Model *model_;
  InstrumentBodies bodies_;
  std::vector<ContactPair> contact_pairs_;
};

}  // namespace mvs::core
