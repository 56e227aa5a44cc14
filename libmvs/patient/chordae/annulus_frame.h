// The annulus of a patient as a curve over the feet of the coordinates, and the frame of the valve.
#pragma once

#include "patient/patient_geometry.h"

namespace mvs::core {

// The annulus with its feet at rest and any positions of its nodes, as those under load.
class AnnulusCurve {
 public:
  // `x` has at least the nodes of the sheet.
  AnnulusCurve(const PatientGeometry &g, const std::vector<Vec3> &x);

  Vec3 at(double foot) const;  // any foot, periodic
  double length() const { return length_; }
  const std::vector<Vec3> &points() const { return points_; }

 private:
  double length_;
  std::vector<double> foot_;  // ascending from 0
  std::vector<Vec3> points_;
};

// Right-handed frame of an annulus. Rows of `axes`: towards the posteromedial commissure, towards
// the A point, into the atrium.
struct AnnulusFrame {
  Vec3 origin = Vec3::Zero();  // centroid by arc length
  Mat3 axes = Mat3::Identity();
  double width = 0;     // m, between the commissures
  double diameter = 0;  // m, between A and P point
  double middle = 0;    // m, of the commissures along the first axis

  Vec3 local(const Vec3 &p) const { return axes * (p - origin); }
  Vec3 global(const Vec3 &p) const { return origin + axes.transpose() * p; }
};

AnnulusFrame annulus_frame(const PatientGeometry &g, const AnnulusCurve &annulus);

}  // namespace mvs::core
