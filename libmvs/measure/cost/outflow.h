// Lengths of the leaflets and place of the coaptation, which decide whether the anterior leaflet
// can be drawn into the outflow tract.
#pragma once

#include <optional>
#include <vector>

#include "model/model.h"

namespace mvs::core {

// In the central AP plane, or beside a seam there (section_planes.h): then means of both sides. NaN
// where the plane finds no leaflet or no coaptation.
struct Outflow {
  double anterior_height, posterior_height;  // m, annulus to free edge, in the rest shape
  double anterior_length, posterior_length;  // m, annulus to the coaptation, in the present shape
  std::optional<Vec3> coaptation;            // m, where it begins: the middle of both leaflets

  // Anterior over posterior length.
  double ratio() const { return anterior_length / posterior_length; }
  // The nearest of the points to the coaptation; none without one or the other.
  std::optional<Vec3> nearest_of(const std::vector<Vec3> &septum) const;
};
Outflow measure_outflow(const Model &model, const std::vector<Vec3> &x);

// Conditions of systolic anterior motion after a repair (Maslow et al., JACC 34, 1999; limits as in
// Popa et al., J. Cardiothorac. Surg. 8 (suppl. 2), 2013).
inline constexpr double sam_ratio = 1.3;
inline constexpr double sam_distance = 25e-3;  // m

// Mean pressure drop of a flow through an orifice: rho / 2 (Q / (C A))^2, the equation of Gorlin
// and Gorlin (Am. Heart J. 41, 1951), whose discharge coefficient of the mitral valve is 0.85. Pa
// from m3/s, m2, kg/m3.
inline double pressure_drop(double flow, double area, double density, double discharge) {
  const double speed = flow / (discharge * area);
  return 0.5 * density * speed * speed;
}

}  // namespace mvs::core
