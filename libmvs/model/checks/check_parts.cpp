// Checks names, ids and material constants.
#include <algorithm>
#include <map>
#include <set>

#include "base/utf8.h"
#include "model/checks/checks.h"
#include "model/chord_law.h"
#include "model/text.h"
#include "model/valve_arrays.h"

namespace mvs::core {
namespace {

template <typename Part>
void check_names(const CowVector<Part> &parts, const char *kind, bool needed, Faults &faults) {
  std::map<std::string, size_t> seen;
  for (size_t k = 0; k < parts.size(); ++k) {
    const std::string &name = parts[k].name;
    const std::string part = format("%s %zu", kind, k);
    if (name.empty()) {
      if (needed) faults.add(part, "%s has no name", part.c_str());
      continue;
    }
    if (name.size() > name_limit) {
      faults.add(part, "the name of %s has %zu bytes, the limit is %zu", part.c_str(), name.size(),
                 name_limit);
    }
    if (!is_plain_text(name)) {
      faults.add(part, "the name of %s has a control character in it", part.c_str());
    }
    if (!is_utf8(name)) {
      faults.add(part, "the name of %s is not UTF-8: names are UTF-8, convert it", part.c_str());
    }
    if (const auto [other, is_new] = seen.emplace(name, k); !is_new) {
      faults.add(part, "%s has the same name as %s %zu, \"%.63s\"", part.c_str(), kind,
                 other->second, name.c_str());
    }
  }
}

// Leaves room for all ids that are still to be assigned.
constexpr Id id_limit = Id{1} << 62;

template <typename Part>
void check_ids(const CowVector<Part> &parts, const char *kind, std::set<Id> &seen, Faults &faults) {
  for (size_t k = 0; k < parts.size(); ++k) {
    const Id id = parts[k].id;
    if (id == 0) continue;
    const std::string part = format("%s %zu", kind, k);
    if (id >= id_limit) {
      faults.add(part, "%s has id %llu: ids are below 2^62", part.c_str(),
                 static_cast<unsigned long long>(id));
    }
    if (!seen.insert(id).second) {
      faults.add(part, "%s has id %llu, which another part has", part.c_str(),
                 static_cast<unsigned long long>(id));
    }
  }
}

// The valid range of a quantity; a NaN is outside of every range.
struct Range {
  double low, high;
  const char *unit, *hint;                              // hint for a value that is too large
  const char *low_hint = "too small, or not a number";  // hint for other values
};
constexpr Range thickness_range = {1e-5, 2e-2, "m", "looks like mm given as m"};
constexpr const char *low_modulus = "looks like MPa or GPa given as Pa, or not a number";
constexpr Range modulus_range = {1, 1e12, "Pa", "moduli are in Pa", low_modulus};
constexpr Range density_range = {100, 20000, "kg/m3", "tissue has about 1060",
                                 "looks like g/cm3 given as kg/m3: tissue has about 1060"};
constexpr Range area_range = {1e-11, 1e-3, "m2", "looks like mm2 given as m2"};
// the shortest segment in meshes of chordae is about 0.1 mm
constexpr Range length_range = {1e-6, 1, "m", "looks like mm given as m"};
constexpr Range gap_range = {1e-6, 1e-2, "m", "looks like mm given as m"};
constexpr Range scale_range = {0, 1e6, "", "1 is the sheet's own bending stiffness"};

void check_range(const std::string &part, const char *what, double value, const Range &range,
                 Faults &faults) {
  if (value >= range.low && value <= range.high) return;
  faults.add(part, "%s has %s %g%s%s, outside %g to %g: %s", part.c_str(), what, value,
             *range.unit ? " " : "", range.unit, range.low, range.high,
             value > range.high ? range.hint : range.low_hint);
}

// Checks that a law exists, that its constants are in range, and that surplus constants are 0.
template <typename Law, typename Values>
void check_law(const std::string &part, Enum auto id, const Law *law, const Values &values,
               Faults &faults) {
  if (!law) {
    faults.add(part, "%s follows law %u, which this library does not know", part.c_str(),
               static_cast<uint32_t>(id));
    return;
  }
  for (size_t k = 0; k < values.size(); ++k) {
    if (k < law->constants.size()) {
      const Constant &c = law->constants[k];
      const bool is_modulus = *c.unit != 0;
      const Range range = is_modulus
                              ? Range{c.low, c.high, c.unit, "moduli are in Pa", low_modulus}
                              : Range{c.low, c.high, c.unit, "strains are fractions, not percent"};
      check_range(part, c.what, values[k], range, faults);
    } else if (values[k] != 0) {
      faults.add(part, "%s has a constant %zu of %g, but its law (%s) has only %zu: make it 0",
                 part.c_str(), k, values[k], law->word, law->constants.size());
    }
  }
}

// Checks a measured curve: strains rise, stress starts at 0 and does not fall, so that a chord
// neither pushes nor jumps.
void check_curve(const ChordCurve &curve, Faults &faults) {
  const std::string part = "curve " + curve.name;
  const auto &points = curve.points.get();
  if (points.size() < 2) {
    faults.add(part, "%s has %zu points: it needs 2 at least", part.c_str(), points.size());
    return;
  }
  if (!(points[0][0] >= 0 && points[0][1] == 0)) {
    faults.add(part,
               "%s starts at strain %g and stress %g Pa: begin where the chord gets taut, "
               "with stress 0",
               part.c_str(), points[0][0], points[0][1]);
  }
  for (size_t k = 1; k < points.size(); ++k) {
    const double step = points[k][0] - points[k - 1][0], rise = points[k][1] - points[k - 1][1];
    if (step > 0 && points[k][0] < 100 && rise >= 0 && points[k][1] < 1e13) continue;
    faults.add(part,
               "%s does not rise at point %zu (strain %g, stress %g Pa): strains have to "
               "rise, stresses must not fall",
               part.c_str(), k, points[k][0], points[k][1]);
    return;
  }
}

// Checks that an Ogden chord has positive stiffness from the start to a strain of 5 %.
void check_ogden(const std::string &part, const Valve &valve, const Chord &chord, Faults &faults) {
  for (size_t k = 0; k < chord.constants.size(); k += 2) {
    if ((chord.constants[k] == 0) == (chord.constants[k + 1] == 0)) continue;
    faults.add(part, "%s has an Ogden term with mu %g Pa and alpha %g: give both, or neither",
               part.c_str(), chord.constants[k], chord.constants[k + 1]);
    return;
  }
  for (const double strain : {1e-6, 0.01, 0.05}) {
    if (chord_response(valve, chord, strain).slope > 0) continue;
    faults.add(part,
               "%s has no positive stiffness at a strain of %g: its Ogden constants do not "
               "describe tissue",
               part.c_str(), strain);
    return;
  }
}

void check_leaflet(const Leaflet &leaflet, size_t k, Faults &faults) {
  const std::string part = part_name("leaflet", leaflet.name, k);
  const LeafletLaw *law = find_leaflet_law(leaflet.law);
  check_law(part, leaflet.law, law, leaflet.constants, faults);
  check_range(part, "thickness", leaflet.thickness, thickness_range, faults);
}

void check_chord_material(const Valve &valve, size_t k, Faults &faults) {
  const Chord &chord = valve.chords[k];
  const std::string part = part_name("chord", chord.name, k);
  check_law(part, chord.law, find_chord_law(chord.law), chord.constants, faults);
  if (chord.law == ChordLawId::ogden) check_ogden(part, valve, chord, faults);
  if (chord.kind > ChordKind::suture) {
    faults.add(part, "%s is of kind %u, which this library does not know", part.c_str(),
               static_cast<uint32_t>(chord.kind));
  }
  check_range(part, "Young's modulus", chord.young, modulus_range, faults);
  check_range(part, "area", chord.area, area_range, faults);
  // 0 stands for the distance of its nodes (complete.cpp)
  if (chord.rest_length != 0) {
    check_range(part, "rest length", chord.rest_length, length_range, faults);
  }
}

void check_valve(const Valve &valve, Faults &faults) {
  if (valve.name.empty() || valve.name.size() > name_limit || !is_plain_text(valve.name)) {
    faults.add("valve",
               "the name of the valve is empty, over %zu bytes, or has a control character",
               name_limit);
  }
  if (!is_utf8(valve.name)) {
    faults.add("valve", "the name of the valve is not UTF-8: names are UTF-8, convert it");
  }
  check_range("valve", "density", valve.density, density_range, faults);
  check_range("valve", "contact thickness", valve.contact_thickness, gap_range, faults);
  check_range("valve", "contact stiffness", valve.contact_stiffness, modulus_range, faults);
  check_range("valve", "bending scale", valve.bending_scale, scale_range, faults);
  for (size_t t = 0; t < valve.triangle_thickness.size(); ++t) {
    const double thickness = valve.triangle_thickness[t];
    if (thickness >= thickness_range.low && thickness <= thickness_range.high) continue;
    check_range(format("triangle %zu", t), "thickness", thickness, thickness_range, faults);
  }
}

}  // namespace

void check_parts(const Valve &valve, Faults &faults) {
  for_each_part_list([&](auto list, const char *kind, bool needs_name) {
    check_names(valve.*list, kind, needs_name, faults);
  });
  std::set<Id> seen;
  for_each_part_list(
      [&](auto list, const char *kind, bool) { check_ids(valve.*list, kind, seen, faults); });
  if (valve.next_id >= id_limit) {
    faults.add("valve", "the next id is %llu: ids are below 2^62",
               static_cast<unsigned long long>(valve.next_id));
  }
  check_valve(valve, faults);
  for (size_t k = 0; k < valve.rings.size(); ++k) {
    const Ring &ring = valve.rings[k];
    if (ring.kind == RingKind::rigid || ring.kind == RingKind::band) continue;
    faults.add("ring " + ring.name, "ring %s is of kind %u, which this library does not know",
               ring.name.c_str(), static_cast<uint32_t>(ring.kind));
  }
  for (size_t k = 0; k < valve.leaflets.size(); ++k) check_leaflet(valve.leaflets[k], k, faults);
  for (size_t k = 0; k < valve.chords.size(); ++k) check_chord_material(valve, k, faults);
  for (const ChordCurve &curve : valve.curves) check_curve(curve, faults);
}

}  // namespace mvs::core
