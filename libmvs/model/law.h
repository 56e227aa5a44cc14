// What tissue does when stretched. One table of leaflet laws and one of chord laws: their words,
// constants and ranges, which the checks, the files and the interface read, and what they compute.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace mvs::core {

using Constants = std::array<double, 8>;

// One constant of a law. `key` is its word in files, `what` its name in sentences.
struct Constant {
  const char *key;
  const char *what;
  const char *unit;
  double fallback, low, high;
};

// The energy density of a membrane in J/m3 and its derivatives by I1 and I4. Every law is convex in
// the in-plane Cauchy-Green strain: not falling in I1, and jointly convex. The element relies on
// it.
struct Response {
  double w, w1, w4, w11, w14, w44;
};

struct LeafletLaw {
  uint32_t id;  // MVS_LEAFLET_LAW_*
  const char *word;
  const char *name;
  std::span<const Constant> constants;
  Response (*response)(const Constants &c, double i1, double i4);  // null: a spring sheet
};

std::span<const LeafletLaw> leaflet_laws();       // in the order of their ids, from 1
const LeafletLaw *find_leaflet_law(uint32_t id);  // null if there is none
Constants default_constants(std::span<const Constant> constants);

// Young's modulus that bending takes: at rest, or where a law starts without stiffness, the secant
// of its uniaxial curve along the fibre at a strain of 0.1.
double bending_modulus(const LeafletLaw &law, const Constants &constants);

// The springs: sigma(e) = low e below the kink, then slope high (Tenenholtz et al. 2011).
// Compression follows the first line. Pa over engineering strain.
struct Bilinear {
  double low = 100e3;
  double high = 6e6;
  double kink = 0.25;

  explicit Bilinear(const Constants &c) : low(c[0]), high(c[1]), kink(c[2]) {}
  double stress(double e) const { return e < kink ? low * e : low * kink + high * (e - kink); }
  double tangent(double e) const { return e < kink ? low : high; }
  // Energy density: the integral of stress over strain, J/m3.
  double energy(double e) const {
    if (e < kink) return 0.5 * low * e * e;
    const double over = e - kink;
    return 0.5 * low * kink * kink + low * kink * over + 0.5 * high * over * over;
  }
};

// The constants of the bilinear membrane whose uniaxial curve is that of the springs.
Constants membrane_like(const Bilinear &springs);

}  // namespace mvs::core
