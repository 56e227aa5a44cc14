// Points of a fine lattice on the sheet, numbered without being stored, with their neighbours.
#pragma once

#include <array>
#include <vector>

#include "model/model.h"

namespace mvs::core::orifice {

// Each triangle is divided into n x n equal parts. Points that triangles share have one number:
// first the nodes, then the points inside edges, then those inside triangles. The sheet must be a
// cylinder: is_cylinder() says so.
class SheetLattice {
 public:
  // Divides triangles so that the mean edge has parts of about `spacing`.
  SheetLattice(const Model &model, const std::vector<Vec3> &x, double spacing);

  // How far around the valve a step leads: `turns` counts crossings of a cut from the annulus to
  // the free edge, and `angle` is the same as a continuous angle, in turns (only a guide).
  struct Step {
    uint32_t to;
    int turns;
    double angle;
  };

  // Numbers of points are below this; papillary heads and branch points have one, too.
  uint32_t size() const;
  Vec3 point(uint32_t v) const;
  // Calls visit(Step) for each neighbour of a point; one on a shared edge may come twice.
  template <typename Visit>
  void for_each_neighbour(uint32_t v, Visit &&visit) const {
    for_each_place(v, [&](const Place &place) {
      const int turns = turns_at(place);
      const double angle = angle_at(place);
      for (const auto &[up, down] : steps) {
        if (place.share[down] == 0) continue;
        Place there = place;
        ++there.share[up];
        --there.share[down];
        visit(Step{number(there), turns_at(there) - turns, angle_at(there) - angle});
      }
    });
  }

 private:
  // A point as seen from a triangle: barycentric weights times n.
  struct Place {
    uint32_t triangle;
    std::array<uint32_t, 3> share;
  };
  static constexpr std::array<std::array<size_t, 2>, 6> steps = {
      {{0, 1}, {1, 2}, {2, 0}, {1, 0}, {2, 1}, {0, 2}}};

  // Calls visit(Place) for each triangle that a point belongs to.
  template <typename Visit>
  void for_each_place(uint32_t v, Visit &&visit) const {
    if (v < first_on_edge_) {
      const Rows &around = model_.topology.node_triangles;
      for (uint32_t i = around.start[v]; i < around.start[v + 1]; ++i) {
        visit(corner_place(around.items[i], v));
      }
    } else if (v < first_inside_) {
      for (const uint32_t t : model_.topology.edge_triangles[(v - first_on_edge_) / (n_ - 1)]) {
        if (t != none) visit(edge_place(t, v));
      }
    } else {
      visit(inside_place(v));
    }
  }
  Place corner_place(uint32_t triangle, uint32_t node) const;
  Place edge_place(uint32_t triangle, uint32_t v) const;
  Place inside_place(uint32_t v) const;
  uint32_t number(const Place &place) const;
  int turns_at(const Place &place) const;
  double angle_at(const Place &place) const;
  void cut_open();
  void spread_angles();

  const Model &model_;
  const std::vector<Vec3> &x_;
  uint32_t n_, first_on_edge_, first_inside_;
  std::vector<std::array<uint32_t, 2>> inside_;  // shares of the points inside a triangle
  std::vector<std::array<int, 3>> turns_;        // per triangle and corner, up to a constant
  std::vector<std::array<double, 3>> angle_;     // the same, turns from corner 0
};

// Returns whether the sheet is a cylinder between the annulus and one free edge.
bool is_cylinder(const Model &model);

}  // namespace mvs::core::orifice
