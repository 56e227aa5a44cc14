// Conversion of Abaqus materials to laws of libmvs.
#include <algorithm>

#include "formats/abaqus/valve.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

constexpr const char *law_names[] = {"no law", "*ELASTIC", "*HYPERELASTIC, NEO HOOKE",
                                     "*HYPERELASTIC, OGDEN", "the user material"};

[[noreturn]] void fail_law(const InpMaterial &material, const char *what, const char *known) {
  inp_fail(material.law_line != 0 ? material.law_line : material.line,
           "material %s has %s, which %s cannot follow: %s", quoted(material.name).c_str(),
           law_names[material.law], what, known);
}

}  // namespace

// An isotropic incompressible sheet of Young's modulus E is neo-Hookean with mu = E / 3.
void set_inp_law(Leaflet &leaflet, const InpMaterial &material, InpNotes &notes) {
  const std::vector<double> &c = material.constants;
  leaflet.constants = {};
  switch (material.law) {
    case InpMaterial::fung:
      leaflet.law = LeafletLawId::fung;
      std::copy(c.begin(), c.end(), leaflet.constants.begin());
      return;
    case InpMaterial::neo_hookean:
      leaflet.law = LeafletLawId::neo_hookean;
      leaflet.constants[0] = c[0];
      return;
    case InpMaterial::ogden:
      if (c.size() != 2 || c[1] != 2) break;
      leaflet.law = LeafletLawId::neo_hookean;
      leaflet.constants[0] = c[0];
      return;
    case InpMaterial::elastic:
      leaflet.law = LeafletLawId::neo_hookean;
      leaflet.constants[0] = c[0] / 3;
      notes.chosen(
          "leaflet %s: *ELASTIC of %g Pa is neo-Hookean with mu = %g Pa, incompressible "
          "whatever Poisson's ratio (%g)",
          quoted(leaflet.name).c_str(), c[0], c[0] / 3, c[1]);
      return;
    case InpMaterial::none_given:
      break;
  }
  fail_law(material, "a leaflet",
           "known are the user material, NEO HOOKE, OGDEN with N=1 and alpha=2, and ELASTIC");
}

void set_inp_law(Chord &chord, const InpMaterial &material) {
  const std::vector<double> &c = material.constants;
  switch (material.law) {
    case InpMaterial::elastic:
      chord.law = ChordLawId::linear;
      chord.young = c[0];
      return;
    case InpMaterial::neo_hookean:
      chord.law = ChordLawId::ogden;
      chord.constants = {c[0], 2};
      return;
    case InpMaterial::ogden:
      chord.law = ChordLawId::ogden;
      std::copy(c.begin(), c.end(), chord.constants.begin());
      return;
    case InpMaterial::fung:
    case InpMaterial::none_given:
      break;
  }
  fail_law(material, "a chord", "known are OGDEN, NEO HOOKE and ELASTIC");
}

}  // namespace mvs::core
