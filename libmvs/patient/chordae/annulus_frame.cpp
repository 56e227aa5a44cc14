// Interpolation along the annulus; axes from its vector area and its landmarks.
#include "patient/chordae/annulus_frame.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "base/error.h"

namespace mvs::core {

AnnulusCurve::AnnulusCurve(const PatientGeometry &g, const std::vector<Vec3> &x)
    : length_(g.coordinates.annulus_length) {
  for (const uint32_t node : g.rims.annulus) {
    foot_.push_back(g.coordinates.foot[node]);
    points_.push_back(x[node]);
  }
}

Vec3 AnnulusCurve::at(double foot) const {
  const double s = wrapped(foot, length_);
  const size_t n = foot_.size();
  const size_t after =
      static_cast<size_t>(std::upper_bound(foot_.begin(), foot_.end(), s) - foot_.begin());
  const size_t k = after > 0 ? after - 1 : 0, next = (k + 1) % n;
  const double end = next == 0 ? length_ : foot_[next];
  const double share = end > foot_[k] ? (s - foot_[k]) / (end - foot_[k]) : 0;
  return points_[k] + share * (points_[next] - points_[k]);
}

AnnulusFrame annulus_frame(const PatientGeometry &g, const AnnulusCurve &annulus) {
  const std::vector<Vec3> &p = annulus.points();
  AnnulusFrame frame;
  double length = 0;
  Vec3 sum = Vec3::Zero();
  for (size_t k = 0; k < p.size(); ++k) {
    const Vec3 &a = p[k], &b = p[(k + 1) % p.size()];
    length += (b - a).norm();
    sum += (b - a).norm() * 0.5 * (a + b);
  }
  frame.origin = sum / length;
  Vec3 area = Vec3::Zero();
  for (size_t k = 0; k < p.size(); ++k) {
    area += 0.5 * (p[k] - frame.origin).cross(p[(k + 1) % p.size()] - frame.origin);
  }
  // a circle has 0.08 of its squared perimeter; a curve with less than an eighth of that has folded
  MVS_MUST(area.norm() > 0.01 * length * length, MVS_E_OP, "annulus",
           "the annulus of %.0f mm encloses only %.0f mm2: it does not go around an opening; give "
           "the points of the annulus",
           length * 1e3, area.norm() * 1e6);
  const Vec3 up = area.normalized();
  const double middle = 0.5 * (g.arcs.from + g.arcs.to);
  const Vec3 across = annulus.at(middle) - annulus.at(middle + 0.5 * annulus.length());
  const Vec3 flat = across - across.dot(up) * up;
  MVS_MUST(flat.norm() > 0.02 * length, MVS_E_OP, "commissures",
           "the middles of both leaflets are %.1f mm apart, on an annulus of %.0f mm: give both "
           "commissures and a point of the anterior leaflet",
           flat.norm() * 1e3, length * 1e3);
  const Vec3 ap = flat.normalized();
  frame.axes.row(0) = ap.cross(up);
  frame.axes.row(1) = ap;
  frame.axes.row(2) = up;
  frame.diameter = flat.norm();
  const double medial = frame.local(annulus.at(g.arcs.from))[0];
  const double lateral = frame.local(annulus.at(g.arcs.to))[0];
  frame.middle = 0.5 * (medial + lateral);
  frame.width = medial - lateral;
  MVS_MUST(frame.width > 0, MVS_E_OP, "commissures",
           "the commissures lie on the wrong sides of the line from P to A point: give both "
           "commissures");
  return frame;
}

}  // namespace mvs::core
