// What tissue does when stretched: the bilinear leaflet curve and the tension-only chord.
#pragma once

#include <algorithm>

namespace mvs {

// sigma(e) = low e below the kink, then continues with slope high (Tenenholtz et al. 2011).
// Compression follows the first line. Pa over engineering strain.
struct Bilinear {
  double low = 100e3;
  double high = 6e6;
  double kink = 0.25;

  double stress(double e) const { return e < kink ? low * e : low * kink + high * (e - kink); }
  double tangent(double e) const { return e < kink ? low : high; }
  // Energy density: the integral of stress over strain, J/m3.
  double energy(double e) const {
    if (e < kink) return 0.5 * low * e * e;
    const double over = e - kink;
    return 0.5 * low * kink * kink + low * kink * over + 0.5 * high * over * over;
  }

  bool operator==(const Bilinear &) const = default;
};

// Tension in N of a cable with axial stiffness ea = E A at engineering strain e; none when slack.
inline double chord_tension(double ea, double e) {
  return ea * std::max(e, 0.0);
}

}  // namespace mvs
