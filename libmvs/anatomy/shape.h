// Smooth surface of a parametric valve, open and in its closed target shape.
#pragma once

#include <array>
#include <numbers>
#include <vector>

#include "anatomy/dimensions.h"
#include "base/types.h"

namespace mvs::core {

inline constexpr double pi = std::numbers::pi;

// Surface coordinates: angle theta around the annulus, 0 at the A point, +-pi at the P point,
// positive on the posteromedial side; v from 0 at the annulus to 1 at the free edge.
struct Place {
  double theta = 0, v = 0;
};

// Frame: x towards the posteromedial commissure, y towards the A point, z into the atrium; the
// origin is the centroid of the annulus. All functions are even in theta except for the sign of x.
class Shape {
 public:
  explicit Shape(const Dimensions &dimensions);

  // Angle of the commissures, at the largest width of the annulus.
  static constexpr double commissure = 1.5707963267948966;
  // Angle of the clefts on either side of P2.
  static double cleft_theta();

  Vec3 annulus(double theta) const;
  // From annulus to free edge along the leaflet.
  double height(double theta) const;
  Vec3 open(const Place &place) const;
  // Target position in the closed valve: from the contracted annulus to the coaptation line, in the
  // founding shape straight, in the healthy one sagging; and vertically below that line.
  Vec3 closed(const Place &place) const;
  // The tips of the posteromedial papillary muscle, anterior one first.
  std::vector<Vec3> medial_tips() const;

 private:
  struct Closed;
  struct Turn {
    double sin, cos;
  };
  static Turn turn_by(double angle);
  static std::array<double, 2> generator(double a, const Turn &at_a, double b, double v);
  bool healthy() const { return d_.shape == ParametricShape::healthy; }
  const Closed &target() const;
  Vec3 annulus(const Turn &theta) const;
  Vec3 coaptation(const Turn &theta) const;
  // Distance from the annulus to the coaptation line.
  double reach(double theta) const;
  double cleft_dip(double t) const;
  double founding_height(double angle) const;
  // `reach` is that at the angle.
  double healthy_height(double angle, const Turn &turn, double reach) const;
  Vec3 founding_open(const Place &place) const;
  Vec3 healthy_open(const Place &place) const;
  // The share at which both leaflets overlap by the same length at A2 and P2.
  double balanced_share() const;

  Dimensions d_;
  double share_ = 0;  // position of the coaptation line from posterior to anterior annulus
  Vec3 centroid_ = Vec3::Zero();
  double tilt_scale_ = 1;
  Turn tilt_ = {0, 1};  // of the founding shape at the annulus
  // reach(), which every height of the healthy shape takes: at the A point, commissure, P point
  double reach_a_ = 0, reach_commissure_ = 0, reach_p_ = 0;
};

// Arc length along the curve v = const of the open surface, and its inverse.
class ArcLength {
 public:
  ArcLength(const Shape &shape, double v, double theta0, double theta1);
  double total() const { return length_.back(); }
  double theta_at(double length) const;

 private:
  double theta0_, theta1_, step_;
  std::vector<double> length_;
};

}  // namespace mvs::core
