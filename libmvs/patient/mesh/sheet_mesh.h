// A sheet of triangles that is edited in place, with the place of each vertex on the sheet from
// which it comes.
#pragma once

#include "patient/mesh/surface_walk.h"

namespace mvs::core {

enum class Rim : uint8_t { inside, annulus, free_edge };

// The sheet that is remeshed.
struct InputSheet {
  // `edge`: of the new mesh, m; normals of a much finer input are averaged over it.
  InputSheet(const LeafletSheet &sheet_in, const SheetRims &rims, double edge)
      : sheet(sheet_in),
        walk(sheet_in.x, sheet_in.triangles, edge),
        annulus(sheet_in, rims.annulus, "annulus"),
        free_edge(sheet_in, rims.free_edge, "free edge") {}
  const RimCurve &curve(Rim rim) const { return rim == Rim::annulus ? annulus : free_edge; }

  const LeafletSheet &sheet;  // outlives this
  SurfaceWalk walk;
  RimCurve annulus, free_edge;
};

// A vertex: its place on the input, near its position, and its part in a rim.
struct MeshVertex {
  SurfacePlace place;
  Vec3 normal = Vec3::Zero();  // of the input at the place
  Rim rim = Rim::inside;
  double arc = 0;                        // on a rim: arc length of the input's
  uint32_t before = none, after = none;  // on a rim: the vertices next to it along the rim
};

// Triangle 3 x `none` is removed; a vertex without triangles is.
struct SheetMesh {
  std::vector<Vec3> x;
  std::vector<MeshVertex> vertex;
  std::vector<Tri> triangles;
  std::vector<std::vector<uint32_t>> star;  // triangles around each vertex

  double length(uint32_t a, uint32_t b) const { return (x[a] - x[b]).norm(); }
  // The triangle that passes from a to b; `none`.
  uint32_t triangle_from(uint32_t a, uint32_t b) const;
  bool are_joined(uint32_t a, uint32_t b) const;
  // Edges once each as (from, to) of a triangle's side, in the order of triangles.
  std::vector<Edge> edges() const;
};

// The input itself. Throws if it is not one sheet with these two rims, wound alike.
SheetMesh mesh_of(const InputSheet &input, const SheetRims &rims);

// A sheet and rims without the removed vertices. Rims begin at the vertex with the least arc
// length; labels come from the input triangle under each centroid, thickness from each place.
struct SheetAndRims {
  LeafletSheet sheet;
  SheetRims rims;
};
SheetAndRims sheet_of(const InputSheet &input, const SheetMesh &mesh);

}  // namespace mvs::core
