// Reads a valve through include/mvs and describes it anew with other numbers.
#include "tests/bench/variants.h"

#include <algorithm>

namespace bench {
namespace {

constexpr double length_range = 0.03, stiffness_range = 0.2, pressure_range = 0.2;

// Numbers within [1 - range, 1 + range] that depend on the number of the variant alone (SplitMix64,
// Steele, Lea & Flood, OOPSLA 2014).
class Factors {
 public:
  explicit Factors(uint64_t number) : state_(number) {}

  double within(double range) {
    uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    z ^= z >> 31;
    return 1 + range * (static_cast<double>(z >> 11) * 0x1p-52 - 1);
  }

 private:
  uint64_t state_;
};

mvs_array array_of(const mvs::Snapshot &valve, mvs_array_kind which) {
  mvs_view view = {};
  mvs::must(mvs_snapshot_get_array(valve.get(), which, &view));
  return {view.data, view.count, view.components, view.type, 0};
}

}  // namespace

Variants::Variants(const mvs::Snapshot &valve) : valve_(valve) {
  const auto ends = valve.view<uint32_t>(MVS_ARRAY_CHORD_NODES);
  const auto kinds = valve.view<uint32_t>(MVS_ARRAY_CHORD_KIND);
  const auto lengths = valve.view<double>(MVS_ARRAY_CHORD_REST_LENGTH);
  const auto young = valve.view<double>(MVS_ARRAY_CHORD_YOUNG);
  const auto area = valve.view<double>(MVS_ARRAY_CHORD_AREA);
  for (size_t c = 0; c < kinds.rows(); ++c) {
    mvs_chord_desc chord = {};
    chord.node_a = ends.begin()[2 * c];
    chord.node_b = ends.begin()[2 * c + 1];
    chord.kind = kinds.begin()[c];
    chord.rest_length = lengths.begin()[c];
    chord.young = young.begin()[c];
    chord.area = area.begin()[c];
    chords_.push_back(chord);
  }
  for (const uint32_t node : valve.view<uint32_t>(MVS_ARRAY_HEAD_NODES)) {
    mvs_head_desc head = {};
    head.node = node;
    heads_.push_back(head);
  }
  const auto laws = valve.view<uint32_t>(MVS_ARRAY_LEAFLET_LAW);
  const auto constants = valve.view<double>(MVS_ARRAY_LEAFLET_CONSTANTS);
  const auto leaflets = valve.parts(MVS_PART_LEAFLET), scallops = valve.parts(MVS_PART_SCALLOP);
  for (const mvs_part &part : leaflets) names_.emplace_back(part.name);
  for (const mvs_part &part : scallops) names_.emplace_back(part.name);
  for (size_t l = 0; l < leaflets.size(); ++l) {
    mvs_leaflet_desc leaflet = {};
    leaflet.name = names_[l].c_str();
    leaflet.law = laws.begin()[l];
    leaflet.thickness = constants.begin()[9 * l];
    std::copy_n(constants.begin() + 9 * l + 1, 8, leaflet.constants);
    leaflets_.push_back(leaflet);
  }
  for (size_t s = leaflets.size(); s < names_.size(); ++s) scallops_.push_back(names_[s].c_str());
}

void Variants::set(mvs::Simulator &sim, uint64_t number) const {
  Factors factors(number);
  std::vector<mvs_chord_desc> chords = chords_;
  std::vector<mvs_leaflet_desc> leaflets = leaflets_;
  const double chordae = factors.within(stiffness_range);
  for (mvs_chord_desc &chord : chords) {
    chord.rest_length *= factors.within(length_range);
    chord.young *= chordae;
  }
  for (mvs_leaflet_desc &leaflet : leaflets)
    leaflet.constants[0] *= factors.within(stiffness_range);
  mvs_valve_desc valve = {};
  valve.nodes = array_of(valve_, MVS_ARRAY_NODE_REST);
  valve.nodes_open = array_of(valve_, MVS_ARRAY_NODE_OPEN);
  valve.nodes_loaded = array_of(valve_, MVS_ARRAY_NODE_LOADED);
  valve.triangles = array_of(valve_, MVS_ARRAY_TRIANGLE_NODES);
  valve.triangle_leaflet = array_of(valve_, MVS_ARRAY_TRIANGLE_LEAFLET);
  valve.triangle_scallop = array_of(valve_, MVS_ARRAY_TRIANGLE_SCALLOP);
  valve.triangle_thickness = array_of(valve_, MVS_ARRAY_TRIANGLE_THICKNESS);
  valve.triangle_fibre = array_of(valve_, MVS_ARRAY_TRIANGLE_FIBRE);
  valve.annulus = array_of(valve_, MVS_ARRAY_ANNULUS_NODES);
  valve.leaflets = leaflets.data();
  valve.leaflet_count = static_cast<uint32_t>(leaflets.size());
  valve.chords = chords.data();
  valve.chord_count = static_cast<uint32_t>(chords.size());
  valve.heads = heads_.data();
  valve.head_count = static_cast<uint32_t>(heads_.size());
  valve.scallops = scallops_.data();
  valve.scallop_count = static_cast<uint32_t>(scallops_.size());
  sim.set_valve(valve);
  sim.set_load(MVS_SYSTOLE_PA * factors.within(pressure_range));
}

}  // namespace bench
