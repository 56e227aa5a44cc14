// Checks of the mesh: crossings, tissue that touches itself, needles, edges below the contact
// thickness, leaflet names, chordae at the annulus.
#include "session/mesh_warnings.h"

#include <algorithm>
#include <string>

#include "base/error.h"
#include "energy/contact.h"
#include "geometry/intersect.h"
#include "measure/annulus/annulus.h"
#include "measure/annulus/landmarks.h"
#include "session/touching_tissue.h"

namespace mvs::core {
namespace {

// A triangle lower than this share of the contact thickness may keep a closure from converging
// (tests/stability, meshes/slivers); a share of 0.1 does not. A real valve with a share of 0.016
// closes, a finer mesh of it with 0.001 does not.
constexpr double needle_share = 0.01;

// Fewer short edges than this share are not warned of: operations leave a few behind, and contact
// is missing only beside them. A valve refined once has two thirds.
constexpr double short_edge_share = 0.01;

struct Needles {
  size_t count = 0;
  double lowest = 0;  // m
  Tri where{};
};

Needles needles_of(const Model &model) {
  const double limit = needle_share * model.valve.contact_thickness;
  Needles found;
  for (uint32_t t = 0; t < model.topology.triangle_edges.size(); ++t) {
    double longest = 0;
    for (const uint32_t edge : model.topology.triangle_edges[t]) {
      longest = std::max(longest, model.rest_length[edge]);
    }
    const double height = 2 * model.rest_area[t] / longest;
    if (height >= limit) continue;
    if (found.count++ == 0 || height < found.lowest) {
      found.lowest = height;
      found.where = model.valve.triangles[t];
    }
  }
  return found;
}

// The remedy for triangles and edges that are too small: a mesh whose edges are well above the
// contact thickness.
std::string remesh_command(const Model &model) {
  const double edge = std::max(2 * model.valve.contact_thickness, mean_edge(model));
  return format("`mvs remesh FILE --edge %.2g -o OUT` (mvs_coarsen_valve)", 1e3 * edge);
}

// All measures and rings depend on the anterior side.
void check_anterior(const Model &model, std::vector<Fault> &found) {
  const Leaflet &leaflet = model.valve.leaflets[anterior_leaflet(model.valve)];
  if (leaflet.name[0] == 'A' || leaflet.name[0] == 'a') return;
  if (model.valve.leaflets.size() > 1) {
    found.push_back({"leaflets", format("no leaflet is named A: %s is assumed to be anterior",
                                        leaflet.name.c_str())});
    return;
  }
  const AnnulusMeasures m = measure_annulus(model, model.valve.rest);
  found.push_back(
      {"leaflets",
       format("no leaflet is named A: the first node of the annulus is assumed to be the middle of "
              "the anterior side, so that the annulus is %.3g mm wide from there (AP) and %.3g mm "
              "across (CC); name leaflets A and P, or start the annulus at that node",
              1e3 * m.ap, 1e3 * m.cc)});
}

void check_crossings(const Model &model, const std::vector<Vec3> &x, std::vector<Fault> &found) {
  constexpr size_t listed = 3;
  const std::vector<Edge> pairs = find_intersections(x, model.valve.triangles);
  if (pairs.empty()) return;
  std::string list;
  for (size_t k = 0; k < std::min(listed, pairs.size()); ++k) {
    list += format("%s%u and %u", k > 0 ? ", " : "", pairs[k][0], pairs[k][1]);
  }
  found.push_back(
      {format("triangle %u", pairs[0][0]),
       format("%zu pairs of triangles cross (triangles %s%s): tissue never passes through tissue, "
              "so they stay entangled, and forces and measures near them are wrong; separate them "
              "in the mesh",
              pairs.size(), list.c_str(), pairs.size() > listed ? ", ..." : "")});
}

std::string scallop_at(const Valve &valve, uint32_t triangle) {
  return valve.scallops[valve.triangle_scallop[triangle]].name;
}

// Such tissue is held apart by the barrier alone, and takes long to come to rest, or never does.
void check_touching(const Model &model, std::vector<Fault> &found) {
  const TouchingTissue touching = find_touching_tissue(model);
  if (touching.vertices == 0) return;
  const Valve &valve = model.valve;
  const Vec3 &p = valve.rest.get()[touching.vertex];
  const double r = valve.contact_thickness;
  const uint32_t beside = model.topology.node_triangles[touching.vertex][0];
  found.push_back(
      {format("node %u", touching.vertex),
       format(
           "%zu vertices lie nearer than the contact thickness of %.3g m at rest to parts of the "
           "leaflets that are not joined to them within %.3g m: node %u of %s at (%.4g, %.4g, "
           "%.4g) m is %.3g m from triangle %u of %s; parts closer than %.3g m at rest do not "
           "touch each other, the barrier only separates them, and the valve may not come to "
           "rest: separate them in the mesh, or give a smaller contact thickness",
           touching.vertices, r, joined_reach * r, touching.vertex,
           scallop_at(valve, beside).c_str(), p.x(), p.y(), p.z(), touching.distance,
           touching.triangle, scallop_at(valve, touching.triangle).c_str(),
           contact_rest_distance * r)});
}

void check_needles(const Model &model, std::vector<Fault> &found) {
  const Needles needles = needles_of(model);
  if (needles.count == 0) return;
  const auto [i, j, k] = needles.where;
  found.push_back(
      {"triangles",
       format("the triangle of nodes %u, %u, %u is %.3g m high, under a hundredth of the contact "
              "thickness of %.3g m (%zu of them): the valve may not come to rest; merge nodes that "
              "are too close, or make another mesh: %s",
              i, j, k, needles.lowest, model.valve.contact_thickness, needles.count,
              remesh_command(model).c_str())});
}

void check_short_edges(const Model &model, std::vector<Fault> &found) {
  const double r = model.valve.contact_thickness;
  const auto thin = std::count_if(model.rest_length.begin(), model.rest_length.end(),
                                  [r](double length) { return length < r; });
  const double edges = static_cast<double>(model.topology.edges.size());
  if (static_cast<double>(thin) <= short_edge_share * edges) return;
  found.push_back(
      {"triangles",
       format("%td of %zu edges are shorter than the contact thickness of %.3g m: parts of the "
              "sheet closer than %.3g m at rest do not touch each other, the barrier only "
              "separates them; for contact there too: a smaller contact thickness, or %s",
              thin, model.topology.edges.size(), r, contact_rest_distance * r,
              remesh_command(model).c_str())});
}

// The heart holds the nodes of the annulus, so that a chord there moves nothing. Where most chordae
// end there, the loop is the free edge.
void check_chords_on_annulus(const Model &model, std::vector<Fault> &found) {
  const Valve &valve = model.valve;
  std::vector<uint8_t> held(model.node_count(), 0);
  for (const uint32_t node : valve.annulus) held[node] = 1;
  size_t count = 0, first = 0;
  for (size_t c = 0; c < valve.chords.size(); ++c) {
    if (!held[valve.chords[c].a] && !held[valve.chords[c].b]) continue;
    if (valve.chords[c].kind != ChordKind::suture && count++ == 0) first = c;
  }
  if (count == 0) return;
  found.push_back(
      {"annulus",
       format(
           "%zu of %zu chordae end at the annulus (the first is %s), which the heart holds: they "
           "move nothing; give other nodes, and check that the loop of the annulus is not that "
           "of the free edge",
           count, valve.chords.size(), valve.chords[first].name.c_str())});
}

}  // namespace

std::vector<Fault> mesh_warnings(const Model &model, const std::vector<Vec3> &x) {
  std::vector<Fault> found;
  check_crossings(model, x, found);
  check_touching(model, found);
  check_short_edges(model, found);
  check_needles(model, found);
  check_anterior(model, found);
  check_chords_on_annulus(model, found);
  return found;
}

}  // namespace mvs::core
