// Self-contact of the sheet: a smooth force between surfaces that face each other within the
// contact thickness, and a short-range barrier that keeps every vertex-triangle and edge-edge pair
// apart.
//
// Contact proper. The energy of a vertex v and the surface that faces it is
//   E_v = kappa A_v / 2 * sum_p c_p r B(d_p / r),   B(s) = -(1 - s)^2 ln s for s < 1,
// r the contact thickness, kappa the contact stiffness, A_v the vertex's rest area, d_p the
// distance to a triangle, edge or vertex. The barrier B is that of Li et al., Incremental Potential
// Contact (2020). The integers c_p count +1 for triangles, -1 for edges, +1 for vertices (the
// inclusion-exclusion of Li et al., Convergent IPC, 2023), so that a flat surface counts once at
// any mesh size. Edges and vertices of a rim count 0, because only features that two triangles
// share are subtracted. So the sheet counts once up to its rim and past it: E = B(distance to the
// sheet) for a flat sheet without notches. Each d_p is the distance to a convex set and smooth
// outside it, so that the force is continuous as the vertex slides across faces, edges, corners and
// rims. Pairs closer than contact_rest_distance * r in the rest shape belong to the same sheet and
// are left out. Two sheets pressed together by p rest at the distance where -kappa B'(d / r) = p.
//
// The short-range barrier is the same B for every pair that is not incident, edge-edge pairs
// included, over min(0.2 r, 0.4 times the rest distance): no distance becomes zero.
#pragma once

#include <vector>

#include "base/workers.h"
#include "collision/broad_phase.h"
#include "collision/contact_params.h"
#include "collision/near_barriers.h"
#include "energy/barrier.h"
#include "energy/settings.h"
#include "model/model.h"

namespace mvs::core {

// The barrier of this file, or the contact of the founding paper: a force that grows with depth up
// to a bound, between vertices and triangles only, without a short-range barrier.
enum class ContactLaw { barrier, penalty };

// m2 of rest area that belongs to an edge of the topology: a third of its triangles.
double edge_area(const Model &model, uint32_t edge);

// Strengths (barrier.h) of the pairs of a vertex, and of two edges with these areas.
inline double vertex_strength(const Model &model, uint32_t vertex) {
  return 0.5 * model.valve.contact_stiffness * model.vertex_area[vertex];
}
inline double edge_strength(const Model &model, double first_area, double second_area) {
  return 0.25 * model.valve.contact_stiffness * (first_area + second_area);
}

// The same of the short-range barrier between a tool and a part of the sheet with this third of its
// rest area. `max_force`, N: what the hand of the tool pulls with.
inline double tool_barrier_strength(const Model &model, double area, double max_force) {
  return 0.5 * model.valve.contact_stiffness * area + settings::instrument::force_share * max_force;
}

class ContactTerm {
 public:
  explicit ContactTerm(const Model &model, ContactLaw law = ContactLaw::barrier);

  // Measures the contact pairs at x; `broad_phase` must be valid there. Nullable `workers` share
  // the work.
  void collect(const std::vector<Vec3> &x, const BroadPhase &broad_phase,
               Workers *workers = nullptr);
  const std::vector<ContactPair> &contact_pairs() const { return contact_pairs_; }

  // All three refer to the last collect().
  double energy() const;
  double gradient(std::vector<Vec3> &g) const;
  template <typename Gradient>
  void add_gradient(Gradient &to) const {
    mvs::core::add_gradient(contact_pairs_, curve_, to);
  }
  // Returns false if the pattern lacks a block; add_pairs() returns the pairs of nodes it needs.
  template <typename Assembler>
  bool hessian(const std::vector<Vec3> &x, Curvature curvature, Assembler &assembler) const {
    return add_hessian(contact_pairs_, curve_, x, curvature, assembler);
  }
  // Elements, and the energies of elements first .. last.
  size_t size() const { return contact_pairs_.size(); }
  void energies(size_t first, size_t last, double *to) const {
    energies_of(contact_pairs_, curve_, first, last, to);
  }
  void add_pairs(std::vector<Edge> &pairs) const;

 private:
  // Counts per edge or vertex of the sheet, for one vertex.
  struct Tally {
    std::vector<int> count;
    std::vector<uint8_t> seen;
    std::vector<uint32_t> touched;
    bool meet(uint32_t index);  // returns true the first time
    void clear();
  };
  // Pairs of successive candidates, and the counts that their collection needs.
  struct Collected {
    Tally edges, corners;
    std::vector<ContactPair> pairs;
  };
  void make_room(Collected &to) const;
  void collect_part(const std::vector<Vec3> &x, const BroadPhase &broad_phase, uint32_t part,
                    uint32_t parts, Collected &to) const;
  void collect_together(const std::vector<Vec3> &x, const BroadPhase &broad_phase,
                        Workers &workers);
  void collect_vertex(const std::vector<Vec3> &x, const VertexTriangle *first,
                      const VertexTriangle *last, Collected &to) const;
  void tally(const std::vector<Vec3> &x, uint32_t v, uint32_t triangle, Collected &to) const;
  void add_tallied(const std::vector<Vec3> &x, uint32_t v, Collected &to) const;
  void add_barrier(const std::vector<Vec3> &x, const EdgeEdge &pair, Collected &to) const;
  void add_vertex_triangle(const std::vector<Vec3> &x, const VertexTriangle &pair,
                           Collected &to) const;

  const Model *model_;
  double thickness_;
  ContactLaw law_;
  Barrier (*curve_)(double);
  std::vector<double> edge_area_;
  std::vector<int> edge_share_, corner_share_;  // c_p: -1 and +1 inside the sheet, 0 on its rims
  Collected collected_;
  std::vector<Collected> parts_;  // of several threads
  NearBarriers near_;
  std::vector<ContactPair> contact_pairs_;
};

}  // namespace mvs::core
