// What is said of a mesh that is finer than its contact.
#include "api/mesh_notes.h"

#include "physics/contact.h"

namespace mvs {
namespace {

// Shorter than this share of the contact thickness an edge makes slivers on which a closure may
// never come to rest (tests/stability, meshes/slivers); a share of 0.1 does no harm there.
constexpr double sliver_share = 0.01;

struct Edges {
  size_t thin = 0, count = 0;  // shorter than the contact thickness, all
  double shortest = 0;
  Edge where{};
};

Edges look_at(const Model &model) {
  Edges found;
  const auto &x = model.valve.rest;
  for (const Edge &e : model.topology.edges) {
    const double length = (x[e[0]] - x[e[1]]).norm();
    if (found.count++ == 0 || length < found.shortest) {
      found.shortest = length;
      found.where = e;
    }
    if (length < model.valve.contact_thickness) ++found.thin;
  }
  return found;
}

}  // namespace

void log_mesh(const mvs_sim &sim, const Model &model) {
  const Edges edges = look_at(model);
  const double r = model.valve.contact_thickness;
  if (edges.thin == 0) return;
  const bool sliver = edges.shortest < sliver_share * r;
  if (sliver) {
    sim.log(MVS_LOG_WARNING,
            "the edge from node %u to node %u is %.3g m long, under a hundredth of the contact "
            "thickness of %.3g m: the valve may not come to rest; merge the two nodes",
            edges.where[0], edges.where[1], edges.shortest, r);
  }
  sim.log(MVS_LOG_INFO,
          "%zu of %zu edges are shorter than the contact thickness of %.3g m: places of the sheet "
          "nearer to each other than %.3g m at rest do not touch, they are only kept apart",
          edges.thin, edges.count, r, facing_rest_distance * r);
}

}  // namespace mvs
