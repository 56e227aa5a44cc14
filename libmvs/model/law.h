// Constitutive laws of leaflets. One table each of leaflet laws and chord laws lists their words,
// constants and ranges for the checks, the files and the interface, with the functions that
// evaluate them.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "model/kinds.h"

namespace mvs::core {

using Constants = std::array<double, 8>;

// One constant of a law. `key` is its word in files, `what` its name in error sentences.
struct Constant {
  const char *key;
  const char *what;
  const char *unit;
  double fallback, low, high;
};

// Energy density of a membrane in J/m3 and its derivatives with respect to I1 and I4. Every law is
// convex in the in-plane Cauchy-Green strain: it does not decrease in I1, and is jointly convex.
// The element relies on this.
struct Response {
  double w, w1, w4, w11, w14, w44;
};

struct LeafletLaw {
  LeafletLawId id;
  const char *word;
  const char *name;
  std::span<const Constant> constants;
  Response (*response)(const Constants &c, double i1, double i4);  // null: a spring sheet
};

std::span<const LeafletLaw> leaflet_laws();           // in the order of their ids, from 1
const LeafletLaw *find_leaflet_law(LeafletLawId id);  // null if unknown
Constants default_constants(std::span<const Constant> constants);

// Young's modulus for the bending stiffness: the tangent at rest, for a neo-Hookean sheet at most
// its constant "bending" (0: no limit); for a law without initial stiffness, the secant of its
// uniaxial curve along the fibre at a strain of 0.1.
double bending_modulus(const LeafletLaw &law, const Constants &constants);

// Nominal stress of a sheet under equibiaxial stretch, Pa.
double equibiaxial_stress(const LeafletLaw &law, const Constants &constants, double stretch);

// Bilinear spring law: sigma(e) = low e below the kink, slope high above it (Tenenholtz et al.
// 2011). Compression follows the first branch. Pa over engineering strain.
struct Bilinear {
  double low = 100e3;
  double high = 6e6;
  double kink = 0.25;

  Bilinear(double low_in, double high_in, double kink_in)
      : low(low_in), high(high_in), kink(kink_in) {}
  explicit Bilinear(const Constants &c) : Bilinear(c[0], c[1], c[2]) {}
  double stress(double e) const { return e < kink ? low * e : low * kink + high * (e - kink); }
  double tangent(double e) const { return e < kink ? low : high; }
  // Energy density: the integral of stress over strain, J/m3.
  double energy(double e) const {
    if (e < kink) return 0.5 * low * e * e;
    const double over = e - kink;
    return 0.5 * low * kink * kink + low * kink * over + 0.5 * high * over * over;
  }
};

// Returns the constants of the bilinear membrane that has the uniaxial curve of the springs.
Constants membrane_like(const Bilinear &springs);

}  // namespace mvs::core
