// Constitutive laws of chordae: linear, bilinear, Ogden (incompressible, uniaxial), measured curve.
// A new law adds one case here, one row of the table, and its number in include/mvs/valve.h and
// model/kinds.h.
#include "model/chord_law.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace mvs::core {
namespace {

Axial linear(double young, double e) {
  return {0.5 * young * e * e, young * e, young};
}

Axial bilinear(const Bilinear &law, double e) {
  return {law.energy(e), law.stress(e), law.tangent(e)};
}

// P = sum of 2 mu / alpha (l^(alpha - 1) - l^(-alpha / 2 - 1)): uniaxial, incompressible.
Axial ogden(const Chord::Constants &c, double e) {
  const double l = 1 + e;
  Axial sum;
  for (size_t k = 0; k < c.size(); k += 2) {
    const double mu = c[k], alpha = c[k + 1];
    if (mu == 0) continue;
    // expm1 keeps the digits of a small alpha (fits have 1e-4)
    const double along = math::expm1(alpha * math::log(l)),
                 across = math::expm1(-alpha / 2 * math::log(l));
    sum.energy += 2 * mu / (alpha * alpha) * (along + 2 * across);
    sum.stress += 2 * mu / alpha * (along - across) / l;
    sum.slope +=
        2 * mu / alpha * ((alpha - 1) * along + (alpha / 2 + 1) * across + 1.5 * alpha) / (l * l);
  }
  return sum;
}

// Ogden law with linear continuation beyond 100 MPa, several times the strength of a chord: with an
// alpha of 100 a trial step could otherwise overflow a double.
Axial bounded_ogden(const Chord::Constants &c, double e) {
  constexpr double limit = 100e6;
  const Axial plain = ogden(c, e);
  if (plain.stress <= limit) return plain;
  double low = 0, high = e;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (ogden(c, middle).stress <= limit ? low : high) = middle;
  }
  const Axial at = ogden(c, low);
  const double over = e - low;
  return {at.energy + at.stress * over + 0.5 * at.slope * over * over, at.stress + at.slope * over,
          at.slope};
}

Axial table(const CowVector<CurvePoint> &points, double e) {
  Axial at;
  for (size_t k = 0; k + 1 < points.size() && e > points[k][0]; ++k) {
    const auto [from_strain, from_stress] = points[k];
    const auto [to_strain, to_stress] = points[k + 1];
    at.slope = (to_stress - from_stress) / (to_strain - from_strain);
    const bool last = k + 2 == points.size();
    const double step = (last ? e : std::min(e, to_strain)) - from_strain;
    at.stress = from_stress + at.slope * step;
    at.energy += 0.5 * (from_stress + at.stress) * step;
  }
  return at;
}

constexpr Constant bilinear_cable_constants[] = {{"kink", "kink strain", "", 0.05, 0, 10},
                                                 {"high", "high modulus", "Pa", 100e6, 1, 1e12}};
constexpr double mu = 1e12, alpha = 1e3;
// the alpha of an unused term is 0
constexpr Constant ogden_constants[] = {
    {"mu1", "constant mu1", "Pa", 0, -mu, mu}, {"alpha1", "constant alpha1", "", 0, -alpha, alpha},
    {"mu2", "constant mu2", "Pa", 0, -mu, mu}, {"alpha2", "constant alpha2", "", 0, -alpha, alpha},
    {"mu3", "constant mu3", "Pa", 0, -mu, mu}, {"alpha3", "constant alpha3", "", 0, -alpha, alpha}};
constexpr Constant table_constants[] = {{"curve", "curve", "", 0, 0, 4294967294.0}};

constexpr ChordLaw chord_law_table[] = {
    {ChordLawId::linear, "linear", "linear cable", {}},
    {ChordLawId::bilinear, "bilinear", "bilinear cable", bilinear_cable_constants},
    {ChordLawId::ogden, "ogden", "Ogden", ogden_constants},
    {ChordLawId::table, "table", "measured curve", table_constants}};

}  // namespace

std::span<const ChordLaw> chord_laws() {
  return chord_law_table;
}

const ChordLaw *find_chord_law(ChordLawId id) {
  for (const ChordLaw &law : chord_law_table) {
    if (law.id == id) return &law;
  }
  return nullptr;
}

Axial chord_response(const Valve &valve, const Chord &chord, double strain) {
  if (strain <= 0) return {};
  const auto &c = chord.constants;
  switch (chord.law) {
    case ChordLawId::linear:
      break;
    case ChordLawId::bilinear:
      return bilinear(Bilinear(chord.young, c[1], c[0]), strain);
    case ChordLawId::ogden:
      return bounded_ogden(c, strain);
    case ChordLawId::table:
      return table(valve.curves[static_cast<size_t>(c[0])].points, strain);
  }
  return linear(chord.young, strain);
}

}  // namespace mvs::core
