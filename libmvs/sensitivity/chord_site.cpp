// Forces of a chord with its end beside a node, and their derivative.
#include "sensitivity/chord_site.h"

#include "base/error.h"
#include "model/chord_law.h"

namespace mvs::core {
namespace {

// The derivative of the energy of a chord by its end at y, N; zero if it is slack.
Vec3 gradient_at(const Model &model, const ChordSite &site, const std::vector<Vec3> &x,
                 const Vec3 &y) {
  const Chord &chord = model.valve.chords[site.chord];
  const Vec3 d = y - x[site.other];
  const double length = d.norm(), strain = length / chord.rest_length - 1;
  if (strain <= 0) return Vec3::Zero();
  return chord.area * chord_response(model.valve, chord, strain).stress / length * d;
}

}  // namespace

void check_chord_site(const Model &model, const Parameter &p, size_t place) {
  const Chord &chord = model.valve.chords[p.index];
  const auto on_leaflet = [&](uint32_t node) {
    return model.topology.node_kind[node] == NodeKind::leaflet;
  };
  MVS_MUST(on_leaflet(chord.a) != on_leaflet(chord.b), MVS_E_ARGUMENT, "chord " + chord.name,
           "parameters[%zu]: chord %s does not end on a leaflet: only an insertion has a site to "
           "move",
           place, chord.name.c_str());
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
  const Vec3 d = x[site.node] - x[site.other];
  const double length = d.norm(), strain = length / chord.rest_length - 1;
  if (strain <= 0) return {};
  const Axial at = chord_response(model.valve, chord, strain);
  const Vec3 u = d / length, v = site_direction(site, x);
  const double tension = chord.area * at.stress, along = u.dot(v);
  const Vec3 turned =
      chord.area * at.slope / chord.rest_length * along * u + tension / length * (v - along * u);
  const Vec3 share = tension / site.edge * u;
  std::vector<NodeVector> force;
  for (const NodeVector &f :
       {NodeVector{site.node, turned - share}, {site.toward, share}, {site.other, -turned}}) {
    if (!model.topology.fixed[f.node]) force.push_back(f);
  }
  return force;
}

void add_site_change(const Model &model, std::span<const ParameterStep> steps,
                     const std::vector<Vec3> &x, std::vector<Vec3> &g) {
  for (size_t k = 0; k < steps.size(); ++k) {
    if (steps[k].parameter->kind != ParameterKind::chord_site) continue;
    const ChordSite first = chord_site(model, *steps[k].parameter);
    // a chord whose end moves towards several nodes at once is counted at the first of them
    Vec3 y = x[first.node];
    bool is_counted = false;
    for (size_t l = 0; l < steps.size(); ++l) {
      const Parameter &p = *steps[l].parameter;
      if (p.kind != ParameterKind::chord_site || p.index != first.chord) continue;
      is_counted = is_counted || l < k;
      y += steps[l].by * site_direction(chord_site(model, p), x);
    }
    if (is_counted) continue;
    const Vec3 now = gradient_at(model, first, x, y),
               before = gradient_at(model, first, x, x[first.node]);
    g[first.node] += now - before;
    g[first.other] -= now - before;
    for (const ParameterStep &step : steps) {
      const Parameter &p = *step.parameter;
      if (p.kind != ParameterKind::chord_site || p.index != first.chord) continue;
      const ChordSite site = chord_site(model, p);
      g[site.node] -= step.by / site.edge * now;
      g[site.toward] += step.by / site.edge * now;
    }
  }
}

}  // namespace mvs::core
