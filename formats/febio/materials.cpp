// FEBio materials of leaflets and springs of chordae.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "formats/febio/text.h"
#include "model/chord_law.h"

namespace mvs::core {
namespace {

// kPa, bulk modulus: nearly incompressible. The FEBio case of tests/validation has the same value.
constexpr double bulk = 20e3;

// The energy density in kPa, in plain decimals. `i1` and `i4` are the words for the invariants.
// Bilinear: the integral of c + a (x + sqrt(x2 + s2)) / 2 over x = I1 - Ic.
std::string energy(const Leaflet &leaflet, const std::string &i1, const std::string &i4) {
  const Constants &c = leaflet.constants;
  const auto stress = [&](size_t k) { return feb_plain(c[k] * kpa_per_pa); };
  const auto plain = [&](size_t k) { return feb_plain(c[k]); };
  const std::string over = "(" + i1 + "-3)";
  switch (leaflet.law) {
    case LeafletLawId::bilinear: {
      const std::string x = "(" + i1 + "-" + plain(2) + ")", s2 = feb_plain(c[3] * c[3]);
      const std::string root = "sqrt(" + x + "^2+" + s2 + ")";
      return stress(0) + "*" + over + "+" + feb_plain(c[1] * kpa_per_pa / 4) + "*(" + x + "^2+" +
             x + "*" + root + "+" + s2 + "*ln(" + x + "+" + root + "))";
    }
    case LeafletLawId::fung:
      return feb_plain(c[0] * kpa_per_pa / 2) + "*" + over + "+" +
             feb_plain(c[1] * kpa_per_pa / 2) + "*(exp(" + plain(2) + "*" + over + "^2)-1)";
    case LeafletLawId::may_newman_yin:
      return stress(0) + "*(exp(" + plain(1) + "*" + over + "^2+" + plain(2) + "*(sqrt(" + i4 +
             ")-1)^4)-1)";
    case LeafletLawId::prot:
      return stress(0) + "*(exp(" + plain(1) + "*" + over + "^2+" + plain(2) + "*(" + i4 +
             "-1)^2)-1)";
    case LeafletLawId::neo_hookean:
      return feb_plain(c[0] * kpa_per_pa / 2) + "*" + over;
    case LeafletLawId::spring:
      break;
  }
  fail(MVS_E_UNSUPPORTED, "leaflet " + leaflet.name,
       "leaflet %.63s is a net of springs, which FEBio does not have: give it the bilinear "
       "membrane law, which is fitted to the same curve, and export that",
       leaflet.name.c_str());
}

// "uncoupled hyperelastic" takes W of the isochoric invariants; "trans-iso hyperelastic" takes W of
// the full invariants and J, so that W contains the isochoric and the volumetric part.
void write_leaflet(const Valve &valve, const FebDomain &domain, size_t k, FebText &out) {
  const Leaflet &leaflet = valve.leaflets[domain.leaflet];
  const bool fibres = feb_has_fibres(leaflet.law);
  out.open("material", "id=\"" + std::to_string(k + 1) + "\" " +
                           feb_attribute("name", domain.name) + " type=\"" +
                           (fibres ? "trans-iso hyperelastic" : "uncoupled hyperelastic") + "\"");
  out.leaf("density", feb_number(valve.density, -9));  // kg/mm3
  if (fibres) {
    const std::string w = energy(leaflet, "(I1*J^(-2/3))", "(I4*J^(-2/3))");
    out.leaf("W", w + "+" + feb_plain(bulk / 2) + "*(ln(J))^2");
    out.leaf("fiber", "fibre " + std::to_string(k + 1), "type=\"map\"");
  } else {
    out.leaf("k", bulk);
    out.leaf("W", energy(leaflet, "I1", "I4"));
  }
  out.close("material");
}

// Nodes of the piecewise linear curve of a chord law: its own corners, or, for a curved law, 64
// steps up to 50 N, far above the strength of a chord.
std::vector<double> corners_of(const Valve &valve, const Chord &chord) {
  if (chord.law == ChordLawId::linear) return {0, 0.1};
  if (chord.law == ChordLawId::bilinear) return {0, chord.constants[0], chord.constants[0] + 0.1};
  if (chord.law == ChordLawId::table) {
    std::vector<double> strains;
    const ChordCurve &curve = valve.curves[static_cast<size_t>(chord.constants[0])];
    for (const CurvePoint &point : curve.points) strains.push_back(point[0]);
    return strains;
  }
  constexpr double most = 50;  // N
  double low = 0, high = 2;
  if (chord_tension(valve, chord, high) > most) {
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (chord_tension(valve, chord, middle) > most ? high : low) = middle;
    }
  }
  std::vector<double> strains;
  for (int k = 0; k <= 64; ++k) strains.push_back(high * k / 64);
  return strains;
}

// Force in mN over elongation in mm. FEBio measures the elongation from the distance of the ends: a
// slack chord has no force until its rest length is reached.
void write_spring(const Valve &valve, size_t c, FebText &out) {
  const Chord &chord = valve.chords[c];
  const double distance = (valve.rest[chord.b] - valve.rest[chord.a]).norm();
  const auto at = [&](double strain) {
    return (chord.rest_length * (1 + strain) - distance) * mm_per_m;
  };
  const std::vector<double> strains = corners_of(valve, chord);
  out.open("discrete_material", "id=\"" + std::to_string(c + 1) + "\" " +
                                    feb_attribute("name", chord.name) +
                                    " type=\"nonlinear spring\"");
  out.leaf("scale", "1");
  out.leaf("measure", "elongation");
  out.open("force", "type=\"point\"");
  out.leaf("interpolate", "linear");
  out.leaf("extend", "extrapolate");
  out.open("points");
  // makes the extrapolated force below the first strain zero
  out.leaf("pt", feb_list(std::array{at(strains[0]) - 1, 0.0}));
  for (const double strain : strains) {
    out.leaf("pt", feb_list(std::array{at(strain), chord_tension(valve, chord, strain) * 1e3}));
  }
  out.close("points");
  out.close("force");
  out.close("discrete_material");
}

}  // namespace

bool feb_has_fibres(LeafletLawId law) {
  return law == LeafletLawId::may_newman_yin || law == LeafletLawId::prot;
}

void write_feb_materials(const Valve &valve, const std::vector<FebDomain> &domains, FebText &out) {
  out.open("Material");
  for (size_t k = 0; k < domains.size(); ++k) write_leaflet(valve, domains[k], k, out);
  out.close("Material");
}

void write_feb_springs(const Valve &valve, FebText &out) {
  if (valve.chords.empty()) return;
  out.open("Discrete");
  for (size_t c = 0; c < valve.chords.size(); ++c) write_spring(valve, c, out);
  for (size_t c = 0; c < valve.chords.size(); ++c) {
    out.leaf("discrete", "",
             "dmat=\"" + std::to_string(c + 1) + "\" " +
                 feb_attribute("discrete_set", valve.chords[c].name));
  }
  out.close("Discrete");
}

}  // namespace mvs::core
