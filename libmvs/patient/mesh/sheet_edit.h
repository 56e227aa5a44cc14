// Splits, flips, collapses and moves on a sheet, each of which is made only if the sheet stays a
// manifold with two rims, no changed triangle turns over and none crosses another one.
#pragma once

#include "patient/mesh/sheet_mesh.h"
#include "patient/mesh/triangle_grid.h"

namespace mvs::core {

// Angles by their cosines: of a triangle's least angle, so that more is worse.
double worst_cosine(const Vec3 &a, const Vec3 &b, const Vec3 &c);

// A set of triangles that is replaced by another one: before[k] by after[k], both of triangle
// id[k]; {none, none, none} before a triangle is made and after it is removed.
struct SheetPatch {
  std::vector<uint32_t> id;
  std::vector<Tri> before, after;
};

// Why an edge is flipped or collapsed or a vertex moved: for even spacing (flips towards valence 6,
// 4 on rims; angles may become lower within limits) or to raise the least angle around.
enum class EditFor { spacing, angle };

class SheetEditor {
 public:
  // `edge`: the wanted length (m).
  SheetEditor(const InputSheet &input, SheetMesh &mesh, double edge);

  // All return whether the change was made.

  // Puts a vertex in the middle of the edge, on the input if that is accepted, else on the edge.
  bool split(const Edge &edge);
  // Replaces the edge of two triangles by that of their other corners.
  bool flip(const Edge &edge, EditFor reason);
  // Merges vertex a into b, unless that makes edges longer than `longest`.
  bool collapse(uint32_t a, uint32_t b, double longest, EditFor reason);
  // Takes a vertex of a rim off with the three triangles of the vertex inside behind it, which
  // joins it and its neighbours on the rim alone: no collapse opens such a corner, since two of its
  // vertices have two neighbours in common. The rim then passes along the third triangle's side,
  // unless that is farther from the vertex than the middles of edges may be, or longer than
  // `longest` along the rim.
  bool cut_corner(uint32_t v, double longest);
  // Moves a vertex inside to the place on the input to which a walk towards `target` leads.
  bool move_inside(uint32_t v, const Vec3 &target, EditFor reason);
  // Moves a vertex on a rim to an arc length.
  bool move_along(uint32_t v, double arc, EditFor reason);

  // Worst cosine of the triangles around a vertex.
  double worst_around(uint32_t v) const;

 private:
  // How a patch looks: before or after a change.
  struct Look {
    double worst = -1;  // cosine
    double facing = 1;  // least cosine between a triangle's normal and the input's
    double bend = 1;    // least cosine between the input's normals at the ends of an edge
    double sure_facing = 1, sure_bend = 1;  // the same without needles
    std::vector<Vec3> normal;               // unit, of each triangle; zero without one
    Vec3 area = Vec3::Zero();               // sum of area vectors
  };
  Look look_at(const std::vector<Tri> &triangles) const;
  // halve: a split at the middle of an edge, which changes no shape
  enum class Change { halve, split, flip, star };
  bool keeps_sides(const Look &before, const Look &after, Change change) const;
  bool crosses(const SheetPatch &patch) const;
  bool replace(const SheetPatch &patch, double limit, Change change, const Look &before);
  bool move_to(uint32_t v, const Vec3 &x, const MeshVertex &to, EditFor reason);
  void commit(const SheetPatch &patch);
  SheetPatch star_of(uint32_t v) const;
  bool may_merge(uint32_t a, uint32_t b) const;
  double distance_of_middle(uint32_t a, uint32_t b) const;
  uint32_t valence(uint32_t v) const;

  const InputSheet &input_;
  SheetMesh &mesh_;
  TriangleGrid grid_;
  double edge_;
};

}  // namespace mvs::core
