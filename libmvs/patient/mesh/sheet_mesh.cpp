// Makes the mesh from a sheet, and the sheet from the mesh.
#include "patient/mesh/sheet_mesh.h"

#include <algorithm>

#include "base/error.h"
#include "model/sides.h"

namespace mvs::core {
namespace {

void check_sheet(const LeafletSheet &sheet, const SheetRims &rims) {
  const std::vector<Side> sides = sorted_sides(sheet.triangles);
  size_t open = 0;
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last == first + 1) ++open;
    MVS_MUST(last - first <= 2, MVS_E_OP, "surface",
             "%zu triangles share the edge of vertices %u and %u: a sheet has at most two there",
             last - first, sides[first].edge[0], sides[first].edge[1]);
    MVS_MUST(last - first == 1 || side_from(sheet.triangles, sides[first]) !=
                                      side_from(sheet.triangles, sides[first + 1]),
             MVS_E_OP, "surface",
             "the triangles at the edge of vertices %u and %u are wound against each other",
             sides[first].edge[0], sides[first].edge[1]);
  });
  MVS_MUST(open == rims.annulus.size() + rims.free_edge.size(), MVS_E_OP, "surface",
           "the surface has %zu boundary edges, the annulus and the free edge have %zu: fill its "
           "holes",
           open, rims.annulus.size() + rims.free_edge.size());
}

void mark_rim(SheetMesh &mesh, const InputSheet &input, const std::vector<uint32_t> &loop,
              Rim rim) {
  const RimCurve &curve = input.curve(rim);
  for (size_t k = 0; k < loop.size(); ++k) {
    MeshVertex &v = mesh.vertex[loop[k]];
    MVS_MUST(v.rim == Rim::inside, MVS_E_OP, "surface",
             "vertex %u is twice on the boundary: two tongues of tissue meet in a point", loop[k]);
    v.rim = rim;
    v.arc = curve.start_of(k);
    v.place = curve.place_at(v.arc);
    v.before = loop[(k + loop.size() - 1) % loop.size()];
    v.after = loop[(k + 1) % loop.size()];
  }
}

// Follows a rim from the vertex with the least arc length.
std::vector<uint32_t> loop_of(const SheetMesh &mesh, const std::vector<uint32_t> &number, Rim rim) {
  uint32_t first = none;
  for (uint32_t i = 0; i < mesh.vertex.size(); ++i) {
    if (mesh.star[i].empty() || mesh.vertex[i].rim != rim) continue;
    if (first == none || mesh.vertex[i].arc < mesh.vertex[first].arc) first = i;
  }
  std::vector<uint32_t> loop;
  for (uint32_t i = first; loop.empty() || i != first; i = mesh.vertex[i].after) {
    loop.push_back(number[i]);
  }
  return loop;
}

}  // namespace

uint32_t SheetMesh::triangle_from(uint32_t a, uint32_t b) const {
  for (const uint32_t t : star[a]) {
    const Tri &tri = triangles[t];
    for (size_t k = 0; k < 3; ++k) {
      if (tri[k] == a && tri[(k + 1) % 3] == b) return t;
    }
  }
  return none;
}

bool SheetMesh::are_joined(uint32_t a, uint32_t b) const {
  return triangle_from(a, b) != none || triangle_from(b, a) != none;
}

std::vector<Edge> SheetMesh::edges() const {
  std::vector<Edge> edges;
  edges.reserve(2 * triangles.size());
  for (const Tri &t : triangles) {
    if (t[0] == none) continue;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3];
      const bool inside = vertex[a].rim == Rim::inside || vertex[a].rim != vertex[b].rim;
      if (a < b || (!inside && triangle_from(b, a) == none)) edges.push_back({a, b});
    }
  }
  return edges;
}

SheetMesh mesh_of(const InputSheet &input, const SheetRims &rims) {
  const LeafletSheet &sheet = input.sheet;
  check_sheet(sheet, rims);
  SheetMesh mesh;
  mesh.x = sheet.x;
  mesh.triangles = sheet.triangles;
  mesh.vertex.resize(sheet.x.size());
  mesh.star.resize(sheet.x.size());
  for (uint32_t t = 0; t < sheet.triangles.size(); ++t) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t i = sheet.triangles[t][k];
      mesh.star[i].push_back(t);
      mesh.vertex[i].place = {t, {}};
      mesh.vertex[i].place.weight[k] = 1;
    }
  }
  mark_rim(mesh, input, rims.annulus, Rim::annulus);
  mark_rim(mesh, input, rims.free_edge, Rim::free_edge);
  for (size_t i = 0; i < mesh.x.size(); ++i) {
    if (!mesh.star[i].empty()) mesh.vertex[i].normal = input.walk.normal_at(mesh.vertex[i].place);
  }
  return mesh;
}

SheetAndRims sheet_of(const InputSheet &input, const SheetMesh &mesh) {
  SheetAndRims made;
  LeafletSheet &sheet = made.sheet;
  const LeafletSheet &from = input.sheet;
  std::vector<uint32_t> number(mesh.x.size(), none);
  for (size_t i = 0; i < mesh.x.size(); ++i) {
    if (mesh.star[i].empty()) continue;
    number[i] = static_cast<uint32_t>(sheet.x.size());
    sheet.x.push_back(mesh.x[i]);
    if (from.thickness.empty()) continue;
    const SurfacePlace &place = mesh.vertex[i].place;
    const Tri &under = from.triangles[place.triangle];
    double thickness = 0;
    for (size_t k = 0; k < 3; ++k) thickness += place.weight[k] * from.thickness[under[k]];
    sheet.thickness.push_back(thickness);
  }
  for (const Tri &t : mesh.triangles) {
    if (t[0] == none) continue;
    sheet.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    const Vec3 centroid = (mesh.x[t[0]] + mesh.x[t[1]] + mesh.x[t[2]]) / 3;
    const SurfacePlace under = input.walk.closest_from(mesh.vertex[t[0]].place, centroid);
    sheet.label.push_back(from.label[under.triangle]);
  }
  made.rims.annulus = loop_of(mesh, number, Rim::annulus);
  made.rims.free_edge = loop_of(mesh, number, Rim::free_edge);
  return made;
}

}  // namespace mvs::core
