// Forces of a chord with its end beside a node, and their derivative.
#include "sensitivity/chord_site.h"

#include <algorithm>

#include "base/error.h"
#include "sensitivity/chord_state.h"

namespace mvs::core {
namespace {

// The chord from its other end to y.
ChordState state_to(const Model &model, const ChordSite &site, const std::vector<Vec3> &x,
                    const Vec3 &y) {
  return chord_state(model.valve, model.valve.chords[site.chord], x[site.other], y);
}

// The derivative of the energy of a chord by its end at y, N.
Vec3 gradient_at(const Model &model, const ChordSite &site, const std::vector<Vec3> &x,
                 const Vec3 &y) {
  const ChordState at = state_to(model, site, x, y);
  return model.valve.chords[site.chord].area * at.response.stress * at.along;
}

}  // namespace

void check_chord_site(const Model &model, const Parameter &p, size_t place) {
  const Chord &chord = model.valve.chords[p.index];
  const auto on_leaflet = [&](uint32_t node) {
    return model.topology.node_kind[node] == NodeKind::leaflet;
  };
  MVS_MUST(on_leaflet(chord.a) != on_leaflet(chord.b), MVS_E_ARGUMENT, "chord " + chord.name,
           "parameters[%zu]: chord %s %s: only a chord with one insertion has a site to move",
           place, chord.name.c_str(),
           on_leaflet(chord.a) ? "ends on leaflets at both ends" : "does not end on a leaflet");
  const uint32_t node = on_leaflet(chord.a) ? chord.a : chord.b;
  MVS_MUST(
      p.component < model.node_count() && edge_between(model.topology, node, p.component) != none,
      MVS_E_ARGUMENT, "parameters",
      "parameters[%zu].component is %u: no edge leads from the insertion of chord %s, node %u, "
      "to that node",
      place, p.component, chord.name.c_str(), node);
}

ChordSite chord_site(const Model &model, const Parameter &p) {
  const Chord &chord = model.valve.chords[p.index];
  const bool is_a = model.topology.node_kind[chord.a] == NodeKind::leaflet;
  ChordSite site{p.index, chord.b, p.component, chord.a, 0};
  if (is_a) std::swap(site.node, site.other);
  site.edge = model.rest_length[edge_between(model.topology, site.node, site.toward)];
  return site;
}

Vec3 site_direction(const ChordSite &site, const std::vector<Vec3> &x) {
  return (x[site.toward] - x[site.node]) / site.edge;
}

// d(T u) = [T' u u^T + T / l (1 - u u^T)] v; the share v / L of the force moves from node to node.
std::vector<NodeVector> site_force(const Model &model, const std::vector<Vec3> &x,
                                   const Parameter &p) {
  const ChordSite site = chord_site(model, p);
  const Chord &chord = model.valve.chords[p.index];
  const auto &[u, length, strain, response] = state_to(model, site, x, x[site.node]);
  const Vec3 v = site_direction(site, x);
  const double tension = chord.area * response.stress, along = u.dot(v);
  const Vec3 turned = chord.area * response.slope / chord.rest_length * along * u +
                      tension / length * (v - along * u);
  const Vec3 share = tension / site.edge * u;
  std::vector<NodeVector> force;
  for (const NodeVector &f :
       {NodeVector{site.node, turned - share}, {site.toward, share}, {site.other, -turned}}) {
    if (!model.topology.fixed[f.node]) force.push_back(f);
  }
  return force;
}

// A chord whose end moves towards several nodes at once has all of them.
void add_site_change(const Model &model, std::span<const ParameterStep> steps,
                     const std::vector<Vec3> &x, std::vector<Vec3> &g) {
  struct MovedSite {
    ChordSite site;
    double by;
  };
  std::vector<MovedSite> moved;
  for (const ParameterStep &step : steps) {
    if (step.parameter->kind != ParameterKind::chord_site) continue;
    moved.push_back({chord_site(model, *step.parameter), step.by});
  }
  std::stable_sort(moved.begin(), moved.end(), [](const MovedSite &a, const MovedSite &b) {
    return a.site.chord < b.site.chord;
  });
  for (size_t first = 0, last = 0; first < moved.size(); first = last) {
    const ChordSite &site = moved[first].site;
    Vec3 y = x[site.node];
    for (; last < moved.size() && moved[last].site.chord == site.chord; ++last) {
      y += moved[last].by * site_direction(moved[last].site, x);
    }
    const Vec3 now = gradient_at(model, site, x, y);
    const Vec3 change = now - gradient_at(model, site, x, x[site.node]);
    g[site.node] += change;
    g[site.other] -= change;
    for (size_t k = first; k < last; ++k) {
      const Vec3 share = moved[k].by / moved[k].site.edge * now;
      g[site.node] -= share;
      g[moved[k].site.toward] += share;
    }
  }
}

}  // namespace mvs::core
