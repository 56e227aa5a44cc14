// Cuts of triangles by a plane, joined from the annulus on.
#include "measure/cost/central_profile.h"

#include <cmath>
#include <limits>

#include "measure/annulus/frame.h"
#include "measure/annulus/landmarks.h"

namespace mvs::core {
namespace {

// A plane across the CC axis, at a distance from the centre of the annulus.
class CentralPlane {
 public:
  CentralPlane(const Model &model, const std::vector<Vec3> &x, double offset)
      : x_(x), frame_(valve_frame(model, x)), offset_(offset) {}

  // A node on the plane counts as in front of it, so that each triangle is cut twice or not at all.
  bool cuts(const Edge &edge) const { return (across(edge[0]) < 0) != (across(edge[1]) < 0); }
  Vec3 point_of(const Edge &edge) const {
    const double a = across(edge[0]), b = across(edge[1]);
    return x_[edge[0]] + a / (a - b) * (x_[edge[1]] - x_[edge[0]]);
  }
  double towards_anterior(const Vec3 &p) const { return frame_.local(p)[0]; }

 private:
  double across(uint32_t node) const { return frame_.local(x_[node])[1] - offset_; }

  const std::vector<Vec3> &x_;
  Frame frame_;
  double offset_;
};

// The annulus edge of the leaflet that the plane cuts, the outermost one; `none` without one.
uint32_t first_edge(const Model &model, const CentralPlane &plane, bool anterior) {
  const Valve &valve = model.valve;
  const std::vector<uint32_t> triangles = annulus_triangles(model);
  const uint32_t leaflet = anterior_leaflet(valve);
  uint32_t found = none;
  double furthest = 0;
  for (size_t k = 0; k < triangles.size(); ++k) {
    const uint32_t t = triangles[k];
    const Edge edge = {valve.annulus[k], valve.annulus[(k + 1) % triangles.size()]};
    if (t == none || (valve.triangle_leaflet[t] == leaflet) != anterior || !plane.cuts(edge)) {
      continue;
    }
    const double out = std::abs(plane.towards_anterior(plane.point_of(edge)));
    if (found != none && out <= furthest) continue;
    found = edge_between(model.topology, edge[0], edge[1]);
    furthest = out;
  }
  return found;
}

// The other edge of a triangle that the plane cuts.
uint32_t exit_of(const Topology &topology, const CentralPlane &plane, uint32_t triangle,
                 uint32_t entry) {
  for (const uint32_t e : topology.triangle_edges[triangle]) {
    if (e != entry && plane.cuts(topology.edges[e])) return e;
  }
  return none;
}

}  // namespace

std::vector<ProfilePiece> central_profile(const Model &model, const std::vector<Vec3> &x,
                                          bool anterior, double offset) {
  const Topology &topology = model.topology;
  const CentralPlane plane(model, x, offset);
  std::vector<ProfilePiece> profile;
  uint32_t edge = first_edge(model, plane, anterior);
  if (edge == none) return profile;
  uint32_t triangle = topology.edge_triangles[edge][0];
  while (triangle != none && profile.size() < model.valve.triangles.size()) {
    const uint32_t next = exit_of(topology, plane, triangle, edge);
    if (next == none) break;
    profile.push_back(
        {triangle, plane.point_of(topology.edges[edge]), plane.point_of(topology.edges[next])});
    const Edge &sides = topology.edge_triangles[next];
    triangle = sides[0] == triangle ? sides[1] : sides[0];
    edge = next;
  }
  return profile;
}

double length_of(const std::vector<ProfilePiece> &profile) {
  if (profile.empty()) return std::numeric_limits<double>::quiet_NaN();
  double length = 0;
  for (const ProfilePiece &piece : profile) length += (piece.to - piece.from).norm();
  return length;
}

}  // namespace mvs::core
