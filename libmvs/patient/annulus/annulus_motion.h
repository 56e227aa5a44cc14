// Where the annulus lies under load.
//
// An affine motion is sought with which the annulus meets the rims of the closed leaflets
// (iterative closest points, Besl and McKay 1992), with a weak preference for none: rims from
// images are rough and may lack parts, and their free edges are rims as well. So the annulus keeps
// its local shape, and its size, place and tilt change. Rims within 6 mm count; where too few do,
// rims within 12 mm, and the motion that they show is doubtful: it may be that of an image. A given
// curve is of the annulus alone: the affine motion brings the annulus near to it, each point has
// its place along it, and the annulus moves by the long waves of the way to these places: shorter
// ones are errors of both curves.
#pragma once

#include <optional>
#include <vector>

#include "measure/comparison/register.h"
#include "patient/annulus/curve_waves.h"
#include "patient/fit/surface_match.h"
#include "patient/leaflet_sheet.h"

namespace mvs::core {

class AnnulusMotion {
 public:
  bool moves() const { return moves_; }
  // The loaded place of a point of the annulus.
  Vec3 operator()(const Vec3 &p) const;

 private:
  friend AnnulusMotion find_annulus_motion(const std::vector<Vec3> &, const std::vector<Vec3> &,
                                           const ClosedSurface &, Findings &);
  Vec3 affine(const Vec3 &p) const { return p + stretch_ * (p - centre_) + shift_; }
  // Returns false if the curve does not run once around the annulus.
  bool move_to(const std::vector<Vec3> &annulus, const std::vector<Vec3> &curve);

  bool moves_ = false;
  Vec3 centre_ = Vec3::Zero(), shift_ = Vec3::Zero();
  Mat3 stretch_ = Mat3::Zero();
  std::optional<CurveWaves> waves_;  // towards a given curve
};

// `annulus`: points along it at rest. `given`: points along the loaded annulus in any order; empty:
// not known. Adds the finding "closed_annulus", or "annulus_motion" if too little is seen, unless
// neither a curve nor a surface is given. Throws where given points are no curve around the
// annulus, or lie elsewhere.
AnnulusMotion find_annulus_motion(const std::vector<Vec3> &annulus, const std::vector<Vec3> &given,
                                  const ClosedSurface &closed, Findings &findings);

// The rigid motion nearest to that of these points of the annulus.
Rigid rigid_part(const AnnulusMotion &motion, const std::vector<Vec3> &annulus);

}  // namespace mvs::core
