// Unit checks of tissue by the response under systolic pressure.
#include "session/unit_warnings.h"

#include <mvs/sim.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <numbers>
#include <numeric>
#include <span>
#include <string>

#include "base/error.h"
#include "model/chord_law.h"

namespace mvs::core {
namespace {

// Values in kPa or MPa read as Pa are at most a thousandth of the true ones: a constant below a
// hundredth of its published value is reported. Published values of one law lie within a factor of
// 10.
constexpr double little = 0.01;
// Leaflet strains are 0.1 to 0.4 (tests/validation). A neo-Hookean sheet of 0.4 mm with a shear
// modulus of 33 kPa would stretch to 7 times its length; fixed pericardium (50 MPa) has a strain of
// 0.002.
constexpr double longest_stretch = 10, least_strain = 1e-3;
// Pa, a hundredth of the default. A softer contact carries systolic pressure only at gaps below a
// hundredth of its thickness (libmvs/energy/README.md).
constexpr double softest_contact = 200;

// Length scale from the area of the leaflets as a disc: half its radius approximates the radius of
// curvature of a closed leaflet.
struct Scale {
  double area, curvature;
  explicit Scale(const Model &model)
      : area(std::accumulate(model.rest_area.begin(), model.rest_area.end(), 0.0)),
        curvature(0.5 * std::sqrt(area / std::numbers::pi)) {}
  // Laplace's law of a sphere, N/m
  double membrane_tension() const { return 0.5 * MVS_SYSTOLE_PA * curvature; }
};

// Returns the first constant in Pa below its lower bound, or null.
const Constant *too_small(std::span<const Constant> law, std::span<const double> values,
                          double &value) {
  for (size_t k = 0; k < law.size(); ++k) {
    const Constant &c = law[k];
    value = values[k];
    const bool is_none = value == 0 && c.low == 0;
    if (*c.unit && value < little * c.fallback && !is_none) return &c;
  }
  return nullptr;
}

void log_leaflet(const mvs_sim &sim, const Leaflet &leaflet, const Scale &scale) {
  const LeafletLaw &law = *find_leaflet_law(leaflet.law);
  const auto stress = [&](double stretch) {
    return equibiaxial_stress(law, leaflet.constants, stretch);
  };
  const double needed = scale.membrane_tension() / leaflet.thickness;
  double value = 0;
  if (const Constant *c = too_small(law.constants, leaflet.constants, value)) {
    sim.log(MVS_LOG_WARNING,
            "leaflet %s has %s %g Pa, tissue about %g: looks like kPa or MPa given as Pa",
            leaflet.name.c_str(), c->what, value, c->fallback);
  } else if (stress(longest_stretch) < needed) {
    sim.log(
        MVS_LOG_WARNING,
        "leaflet %s would stretch to over %g times its length under 120 mmHg: looks like moduli "
        "in kPa or MPa given as Pa",
        leaflet.name.c_str(), longest_stretch);
  } else if (stress(1 + least_strain) > needed) {
    sim.log(MVS_LOG_WARNING,
            "leaflet %s would stretch by less than %g %% under 120 mmHg, tissue does by 10 to 40: "
            "moduli are in Pa",
            leaflet.name.c_str(), 100 * least_strain);
  }
  const double thickest = scale.curvature / 3, thinnest = scale.curvature / 300;
  if (leaflet.thickness >= thinnest && leaflet.thickness <= thickest) return;
  sim.log(MVS_LOG_WARNING,
          "leaflet %s is %.3g mm thick, which is %s for a valve of this size (%.3g to %.3g mm): "
          "check its unit (m in the library, mm in the command)",
          leaflet.name.c_str(), 1e3 * leaflet.thickness,
          leaflet.thickness > thickest ? "too much" : "little", 1e3 * thinnest, 1e3 * thickest);
}

// A warning about chordae: the name of the first, and the number of them.
struct ChordWarning {
  size_t count = 0;
  std::string first;
  void add(const Chord &chord, const std::string &sentence) {
    if (count++ == 0) first = "chord " + chord.name + " " + sentence;
  }
  void log(const mvs_sim &sim) const {
    if (count == 0) return;
    sim.log(MVS_LOG_WARNING, "%s (%zu of them)", first.c_str(), count);
  }
};

size_t leaflet_ends(const Model &model) {
  size_t ends = 0;
  for (const Chord &chord : model.valve.chords) {
    for (const uint32_t node : {chord.a, chord.b}) {
      ends += model.topology.node_kind[node] != NodeKind::branch &&
              model.topology.node_kind[node] != NodeKind::head;
    }
  }
  return ends;
}

// The first strain, in steps of 1 % up to 1, at which a chord satisfies a condition; 0: at none.
template <typename Condition>
double first_strain(Condition holds) {
  for (int percent = 1; percent <= 100; ++percent) {
    if (holds(0.01 * percent)) return 0.01 * percent;
  }
  return 0;
}

// No chord bears twice its length: a measured curve that ends beyond has its strains in percent.
bool judge_curve(const Valve &valve, const Chord &chord, ChordWarning &curves) {
  constexpr double longest_strain = 1;
  if (chord.law != ChordLawId::table) return false;
  const ChordCurve &curve = valve.curves[static_cast<size_t>(chord.constants[0])];
  const double last = curve.points.back()[0];
  if (last <= longest_strain) return false;
  curves.add(chord, format("follows curve %s, which ends at a strain of %g: strains are ratios, "
                           "0.3 for 30 %%",
                           curve.name.c_str(), last));
  return true;
}

// An Ogden chord whose terms have different signs may stiffen at first, pull less beyond a strain,
// and push beyond another. Returns whether it does.
bool judge_falling(const Valve &valve, const Chord &chord, ChordWarning &falling) {
  if (chord.law != ChordLawId::ogden) return false;
  const double falls =
      first_strain([&](double strain) { return chord_response(valve, chord, strain).slope < 0; });
  if (falls == 0) return false;
  const double pushes =
      first_strain([&](double strain) { return chord_tension(valve, chord, strain) < 0; });
  std::string sentence = format("pulls less again from a strain of %.2f on", falls);
  if (pushes > 0) sentence += format(", and pushes from %.2f on", pushes);
  falling.add(chord, sentence + ": its Ogden constants describe no tissue there");
  return true;
}

// The modulus of a bilinear chord beyond its kink, if it is too small, or null.
const Constant *small_modulus(const Chord &chord, double &value) {
  if (chord.law != ChordLawId::bilinear) return nullptr;
  return too_small(find_chord_law(chord.law)->constants, chord.constants, value);
}

// Soft: a chord that yields to its share of the pressure, or bears less than 50 kPa at a strain of
// 0.5 (the softest natural chordae have a modulus of 10 MPa). Stiff: as stiff as steel wire of 0.4
// mm.
void judge_stiffness(const Valve &valve, const Chord &chord, double share, ChordWarning &soft,
                     ChordWarning &stiff) {
  double value = 0;
  const double stress = chord_response(valve, chord, 0.5).stress;
  const double doubled = chord_tension(valve, chord, 1),
               slightly = chord_tension(valve, chord, 0.01);
  if (doubled < share) {
    soft.add(chord, format("bears %.3g N at twice its length, its share of the systolic force is "
                           "%.3g N: looks like a modulus in kPa or MPa given as Pa",
                           doubled, share));
  } else if (stress < 50e3) {
    soft.add(chord, format("bears %.3g kPa at half again its length, tissue bears MPa: looks like "
                           "a modulus in kPa or MPa given as Pa",
                           1e-3 * stress));
  } else if (const Constant *c = small_modulus(chord, value)) {
    soft.add(chord, format("has %s %g Pa, tissue about %g: looks like kPa or MPa given as Pa",
                           c->what, value, c->fallback));
  } else if (slightly > 200) {
    stiff.add(chord, format("bears %.3g N at a strain of 1 %%, as steel wire does: young is in Pa, "
                            "area in m2",
                            slightly));
  }
}

// In an open valve whose leaflets hang below the heads, chordae are up to 8 times their rest
// length; a relative length (0.98 for 98 % of the distance) is about 50 times too long.
void judge_length(const Valve &valve, const Chord &chord, ChordWarning &lengths) {
  constexpr double shorter = 20, longer = 10;
  const double distance = (valve.rest[chord.a] - valve.rest[chord.b]).norm();
  if (distance <= shorter * chord.rest_length && chord.rest_length <= longer * distance) return;
  lengths.add(chord, format("is %.3g mm long at rest, and its ends lie %.3g mm apart: rest_length "
                            "is in m, not a share of the distance",
                            1e3 * chord.rest_length, 1e3 * distance));
}

bool has_leaflet(const Model *before, const Leaflet &leaflet) {
  if (!before) return false;
  const auto &leaflets = before->valve.leaflets;
  return std::find(leaflets.begin(), leaflets.end(), leaflet) != leaflets.end();
}

// The chordae of a model by their ids; none without a model.
class KnownChords {
 public:
  explicit KnownChords(const Model *model) {
    if (!model) return;
    for (const Chord &chord : model->valve.chords) chords_[chord.id] = &chord;
  }
  // Whether a chord of this id has the same length and response. Its nodes may have other numbers.
  bool has(const Chord &chord) const {
    const auto found = chords_.find(chord.id);
    if (found == chords_.end()) return false;
    const Chord &known = *found->second;
    return known.rest_length == chord.rest_length && known.law == chord.law &&
           known.young == chord.young && known.area == chord.area &&
           known.constants == chord.constants;
  }

 private:
  std::map<Id, const Chord *> chords_;
};

void log_chords(const mvs_sim &sim, const Model &model, const Scale &scale, const Model *before) {
  const Valve &valve = model.valve;
  const size_t ends = leaflet_ends(model);
  if (ends == 0) return;
  // the annulus spans about half the area of the leaflets
  const double share = 0.5 * MVS_SYSTOLE_PA * scale.area / static_cast<double>(ends);
  const KnownChords known(before);
  ChordWarning soft, stiff, falling, curves, lengths;
  for (const Chord &chord : valve.chords) {
    if (chord.kind == ChordKind::suture) continue;  // made by the library
    if (known.has(chord)) continue;
    if (!judge_falling(valve, chord, falling) && !judge_curve(valve, chord, curves)) {
      judge_stiffness(valve, chord, share, soft, stiff);
    }
    judge_length(valve, chord, lengths);
  }
  soft.log(sim);
  stiff.log(sim);
  falling.log(sim);
  curves.log(sim);
  lengths.log(sim);
}

void log_all(const mvs_sim &sim, const Model &model, const Model *before) {
  const Scale scale(model);
  const double contact = model.valve.contact_stiffness;
  const bool is_known = before && before->valve.contact_stiffness == contact;
  if (contact < softest_contact && !is_known) {
    sim.log(MVS_LOG_WARNING,
            "the contact stiffness is %g Pa, the default 20000: looks like kPa given as Pa",
            contact);
  }
  for (const Leaflet &leaflet : model.valve.leaflets) {
    if (!has_leaflet(before, leaflet)) log_leaflet(sim, leaflet, scale);
  }
  log_chords(sim, model, scale, before);
}

}  // namespace

void log_units(const mvs_sim &sim, const Model &model, const Model *before) {
  if (!sim.desc.log) return;
  try {
    log_all(sim, model, before);
  } catch (const std::bad_alloc &) {  // NOLINT(bugprone-empty-catch): the call itself is done
  }
}

}  // namespace mvs::core
