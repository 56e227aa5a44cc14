// Heads, trees of chordae and their rest lengths.
#include "patient/chordae/patient_chordae.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "patient/chordae/chord_places.h"
#include "patient/chordae/closed_target.h"

namespace mvs::core {
namespace {

// Place of a branch point on the way from tip to leaflet, as in the healthy parametric valve.
constexpr double trunk_share = 0.4;
// Strain of chordae at systole, which their rest lengths leave out: measured are 4.3 +- 3.4 %, of
// the parametric valve's chordae of 1 mm and 40 MPa 1 to 2 %.
constexpr double systolic_strain = 0.015;
// m: a chord that is shorter in the closed valve cannot be built.
constexpr double least_length = 1e-3;

uint32_t add_node(Valve &valve, const Vec3 &p) {
  const uint32_t node = static_cast<uint32_t>(valve.rest.size());
  valve.rest.push_back(p);
  if (!valve.open.empty()) valve.open.push_back(p);
  if (!valve.loaded.empty()) valve.loaded.push_back(p);
  if (!valve.origin.empty()) valve.origin.push_back(none);
  return node;
}

// One muscle: its heads in the valve, and closed places of leaflet vertices.
struct Muscle {
  const std::vector<Vec3> &tips, &loaded_tips;
  uint32_t first_head;
  const std::vector<Vec3> &closed;
  double length_factor;
};

uint32_t add_heads(Valve &valve, const std::vector<Vec3> &tips, const std::vector<Vec3> &loaded,
                   const char *name) {
  const uint32_t first = static_cast<uint32_t>(valve.rest.size());
  for (size_t k = 0; k < tips.size(); ++k) {
    valve.heads.push_back({0, format("%s%zu", name, k + 1), add_node(valve, tips[k])});
    if (!valve.loaded.empty()) valve.loaded.edit()[valve.heads.get().back().node] = loaded[k];
  }
  return first;
}

size_t nearest_tip(const std::vector<Vec3> &tips, const Vec3 &x) {
  size_t best = 0;
  for (size_t k = 1; k < tips.size(); ++k) {
    if ((tips[k] - x).squaredNorm() < (tips[best] - x).squaredNorm()) best = k;
  }
  return best;
}

// A trunk has the cross-section of its leaves.
void add_segment(Valve &valve, const Muscle &muscle, uint32_t a, uint32_t b, ChordKind kind,
                 double closed_length, size_t leaves) {
  MVS_MUST(closed_length >= least_length, MVS_E_OP, "papillary_tips",
           "a chord would be %.2f mm long in the closed valve: a papillary tip is at the leaflets; "
           "give tips at the phase of the surface, below the free edge",
           closed_length * 1e3);
  Chord chord;
  chord.a = a;
  chord.b = b;
  chord.kind = kind;
  chord.area *= static_cast<double>(leaves);
  chord.rest_length = muscle.length_factor * closed_length;
  valve.chords.push_back(chord);
}

void add_tree(Valve &valve, const Muscle &muscle, const ChordTree &tree) {
  const double count = static_cast<double>(tree.leaves.size());
  Vec3 open = Vec3::Zero(), closed = Vec3::Zero();
  for (const uint32_t leaf : tree.leaves) {
    open += valve.rest.get()[leaf] / count;
    closed += muscle.closed[leaf] / count;
  }
  const size_t at = nearest_tip(muscle.loaded_tips, closed);
  const Vec3 &tip = muscle.tips[at], &loaded_tip = muscle.loaded_tips[at];
  uint32_t from = muscle.first_head + static_cast<uint32_t>(at);
  Vec3 from_closed = loaded_tip;
  if (tree.leaves.size() > 1) {
    const uint32_t branch = add_node(valve, tip + trunk_share * (open - tip));
    from_closed = loaded_tip + trunk_share * (closed - loaded_tip);
    add_segment(valve, muscle, from, branch, ChordKind::trunk, (from_closed - loaded_tip).norm(),
                tree.leaves.size());
    from = branch;
  }
  for (const uint32_t leaf : tree.leaves) {
    add_segment(valve, muscle, from, leaf, tree.kind, (muscle.closed[leaf] - from_closed).norm(),
                1);
  }
}

void check(const Valve &valve, const PatientGeometry &g, const PapillaryTips &tips,
           const ChordaeSettings &s) {
  MVS_MUST(valve.rest.size() == g.sheet.x.size(), MVS_E_ARGUMENT, "chords",
           "the valve has %zu nodes and the sheet %zu vertices: chordae are added to the leaflets "
           "alone",
           valve.rest.size(), g.sheet.x.size());
  MVS_MUST(!tips.anterolateral.empty() && !tips.posteromedial.empty(), MVS_E_ARGUMENT,
           "papillary_tips", "each papillary muscle needs a tip");
  MVS_MUST(s.chord_factor >= 0.5 && s.chord_factor <= 2, MVS_E_ARGUMENT, "chord_factor",
           "chord_factor is %g: it has to be 0.5 to 2", s.chord_factor);
}

}  // namespace

void add_chordae(Valve &valve, const PatientGeometry &g, const PapillaryTips &tips,
                 const ChordaeSettings &settings, Findings &findings) {
  check(valve, g, tips, settings);
  const ChordPlan plan = plan_chords(g, settings.chords);
  const AnnulusCurve boundary(g, valve.loaded.empty() ? valve.rest : valve.loaded);
  const ClosedTarget target = closed_target(g, boundary, settings.coaptation_length);
  const double factor = settings.chord_factor / (1 + systolic_strain);
  const std::vector<Vec3> &lateral_tips = tips.anterolateral, &medial_tips = tips.posteromedial;
  const auto loaded = [](const std::vector<Vec3> &under_load,
                         const std::vector<Vec3> &at_rest) -> const std::vector<Vec3> & {
    return under_load.empty() ? at_rest : under_load;
  };
  const std::vector<Vec3> &lateral_loaded = loaded(tips.loaded_anterolateral, lateral_tips);
  const std::vector<Vec3> &medial_loaded = loaded(tips.loaded_posteromedial, medial_tips);
  const uint32_t lateral = add_heads(valve, lateral_tips, lateral_loaded, "AL");
  const uint32_t medial = add_heads(valve, medial_tips, medial_loaded, "PM");
  for (const ChordTree &tree : plan.anterolateral) {
    add_tree(valve, {lateral_tips, lateral_loaded, lateral, target.x, factor}, tree);
  }
  for (const ChordTree &tree : plan.posteromedial) {
    add_tree(valve, {medial_tips, medial_loaded, medial, target.x, factor}, tree);
  }
  findings.push_back(
      {"chordae",
       FindingSource::assumed,
       0.3,
       format("%zu segments in %zu trees with insertions and diameters of normal anatomy, and rest "
              "lengths for an overlap of %.1f mm of the leaflets at A2-P2, %.1f mm below the plane "
              "of the annulus (asked: %.1f mm)",
              valve.chords.size(), plan.anterolateral.size() + plan.posteromedial.size(),
              target.overlap * 1e3, target.depth * 1e3, settings.coaptation_length * 1e3),
       {target.overlap, target.depth},
       "m"});
}

}  // namespace mvs::core
