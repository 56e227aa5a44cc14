// Constitutive laws of leaflets. A new law adds one response function, one row of the table, and
// its number in include/mvs/valve.h and model/kinds.h.
#include "model/law.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace mvs::core {
namespace {

// scale exp(q) up to 100 kPa, where the stress along a stretch is 6 to 11 MPa with the constants
// below: leaflets of aortic and pulmonary valves tear at 0.3 to 2.8 MPa (Biomaterials 225 (2019)
// 119493, table 3). Above, a parabola in sqrt(q), which is about a strain, with the slope of the
// exponential and 2 % of its curvature at the transition. A trial step that crushes a triangle then
// gives a finite value from which a solver recovers, and a few triangles torn or crushed by an
// operation do not stop the others: of 80 operations on closed valves 14 did not come to rest with
// a parabola in q from 100 MPa on, 4 with the full curvature, 0 with this law.
struct Exponential {
  double value, first, second;  // and derivatives with respect to q
};
Exponential bounded_exp(double scale, double q) {
  constexpr double most = 100e3, share = 0.02;
  const double plain = scale * math::exp(q);
  if (plain <= most) return {plain, plain, plain};
  const double edge =
      std::max(math::log(most / scale), 1.0);  // the stress at rest may exceed `most`
  if (q <= edge) return {plain, plain, plain};
  const double top = scale * math::exp(edge), r = std::sqrt(q), over = r - std::sqrt(edge);
  const double start = 2 * std::sqrt(edge) * top, curve = share * (2 + 4 * edge) * top;
  const double slope = start + curve * over;  // by r
  return {top + (start + 0.5 * curve * over) * over, slope / (2 * r),
          (curve - slope / r) / (4 * q)};
}

// W = scale (exp(q) - 1), from the derivatives of q with respect to I1 and I4.
Response exponential(double scale, double q, double q1, double q11, double q4, double q44) {
  const auto [value, first, second] = bounded_exp(scale, q);
  return {value - scale,    first * q1,
          first * q4,       second * q1 * q1 + first * q11,
          second * q1 * q4, second * q4 * q4 + first * q44};
}

// Smooth fit to the curve of the founding paper: c 18.49 kPa, a 3146 kPa, Ic 3.1611, s 0.006. Its
// uniaxial stress lies within 12 % of the curve except at the kink, which it rounds (table of
// tests/verification).
Response bilinear(const Constants &k, double i1, double) {
  const double c = k[0], a = k[1], x = i1 - k[2], s2 = k[3] * k[3], x0 = 3 - k[2];
  const double root = std::sqrt(x * x + s2), root0 = std::sqrt(x0 * x0 + s2);
  // the integral of (x + sqrt(x^2 + s^2)) / 2
  const auto integral = [&](double y, double r) {
    return 0.25 * (y * y + y * r + s2 * math::log(y + r));
  };
  const double w = c * (i1 - 3) + a * (integral(x, root) - integral(x0, root0));
  return {w, c + 0.5 * a * (x + root), 0, 0.5 * a * (1 + x / root), 0, 0};
}

Response fung(const Constants &k, double i1, double) {
  const double x = i1 - 3;
  Response r = exponential(0.5 * k[1], k[2] * x * x, 2 * k[2] * x, 2 * k[2], 0, 0);
  r.w += 0.5 * k[0] * x;
  r.w1 += 0.5 * k[0];
  return r;
}

Response may_newman_yin(const Constants &k, double i1, double i4) {
  const double x = i1 - 3, root = std::sqrt(i4), y = root - 1, y3 = y * y * y;
  const double q44 = k[2] * y * y * (2 * root + 1) / (i4 * root);
  return exponential(k[0], k[1] * x * x + k[2] * y * y3, 2 * k[1] * x, 2 * k[1],
                     2 * k[2] * y3 / root, q44);
}

Response prot(const Constants &k, double i1, double i4) {
  const double x = i1 - 3, y = i4 - 1;
  return exponential(k[0], k[1] * x * x + k[2] * y * y, 2 * k[1] * x, 2 * k[1], 2 * k[2] * y,
                     2 * k[2]);
}

Response neo_hookean(const Constants &k, double i1, double) {
  return {0.5 * k[0] * (i1 - 3), 0.5 * k[0], 0, 0, 0, 0};
}

constexpr double soft = 1e-3, hard = 1e12;  // Pa: softer than any gel, harder than steel
constexpr Constant spring_constants[] = {{"low", "low modulus", "Pa", 100e3, 1, hard},
                                         {"high", "high modulus", "Pa", 6e6, 1, hard},
                                         {"kink", "kink strain", "", 0.25, 0, 10}};
constexpr Constant bilinear_membrane_constants[] = {{"c", "constant c", "Pa", 18.49e3, soft, hard},
                                                    {"a", "constant a", "Pa", 3146e3, soft, hard},
                                                    {"ic", "constant Ic", "", 3.1611, 3, 100},
                                                    {"s", "constant s", "", 0.006, 1e-6, 10}};
constexpr Constant fung_constants[] = {{"c0", "constant c0", "Pa", 1e3, soft, hard},
                                       {"c1", "constant c1", "Pa", 124, soft, hard},
                                       {"c2", "constant c2", "", 4.568202, 1e-6, 1e6}};
constexpr Constant may_newman_constants[] = {{"c0", "constant c0", "Pa", 399, soft, hard},
                                             {"c1", "constant c1", "", 4.325, 1e-6, 1e6},
                                             {"c2", "constant c2", "", 1446.5, 0, 1e6}};
constexpr Constant prot_constants[] = {{"c0", "constant c0", "Pa", 52, soft, hard},
                                       {"c1", "constant c1", "", 4.63, 1e-6, 1e6},
                                       {"c2", "constant c2", "", 22.6, 0, 1e6}};
// The shear modulus is one of tissue under load, the modulus of bending that of the bilinear
// membrane at rest: a plate of 3 mu = 600 kPa keeps folds open that are sealed at 112 kPa.
constexpr Constant neo_hookean_constants[] = {
    {"mu", "shear modulus", "Pa", 2e5, soft, hard},
    {"bending", "modulus of bending", "Pa", 112e3, 0, hard}};

constexpr LeafletLaw leaflet_law_table[] = {
    {LeafletLawId::spring, "spring", "bilinear springs", spring_constants, nullptr},
    {LeafletLawId::bilinear, "bilinear", "bilinear membrane", bilinear_membrane_constants,
     bilinear},
    {LeafletLawId::fung, "fung", "Fung-type membrane", fung_constants, fung},
    {LeafletLawId::may_newman_yin, "may_newman_yin", "May-Newman and Yin", may_newman_constants,
     may_newman_yin},
    {LeafletLawId::prot, "prot", "Prot", prot_constants, prot},
    {LeafletLawId::neo_hookean, "neo_hookean", "neo-Hookean membrane", neo_hookean_constants,
     neo_hookean}};

}  // namespace

std::span<const LeafletLaw> leaflet_laws() {
  return leaflet_law_table;
}

const LeafletLaw *find_leaflet_law(LeafletLawId id) {
  for (const LeafletLaw &law : leaflet_law_table) {
    if (law.id == id) return &law;
  }
  return nullptr;
}

Constants default_constants(std::span<const Constant> constants) {
  Constants values{};
  for (size_t k = 0; k < constants.size(); ++k) values[k] = constants[k].fallback;
  return values;
}

Constants membrane_like(const Bilinear &springs) {
  // the fit to 100 kPa, 6 MPa and 0.25, scaled; its transition lies 0.0014 below I1 at the kink
  const double l = 1 + springs.kink;
  return {18.49e-2 * springs.low, 3146e-3 / 6 * springs.high, l * l + 2 / l - 0.0014, 0.006};
}

double equibiaxial_stress(const LeafletLaw &law, const Constants &constants, double stretch) {
  if (!law.response) return Bilinear(constants).stress(stretch - 1);
  const double l2 = stretch * stretch, l4 = l2 * l2;
  const Response r = law.response(constants, 2 * l2 + 1 / l4, l2);
  return r.w1 * (2 * stretch - 2 / (l4 * stretch)) + r.w4 * stretch;
}

double bending_modulus(const LeafletLaw &law, const Constants &constants) {
  if (!law.response) return Bilinear(constants).low;
  // plane stress, incompressible: E = 6 dW/dI1 at rest
  const double at_rest = 6 * law.response(constants, 3, 1).w1;
  if (law.id == LeafletLawId::neo_hookean && constants[1] > 0) {
    return std::min(at_rest, constants[1]);
  }
  if (at_rest > 0) return at_rest;
  constexpr double strain = 0.1, l = 1 + strain;
  const Response r = law.response(constants, l * l + 2 / l, l * l);
  return (2 * r.w1 * (l - 1 / (l * l)) + 2 * r.w4 * l) / strain;
}

}  // namespace mvs::core
