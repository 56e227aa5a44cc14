// Energy, gradient and Hessian of contact pairs: each pair has a distance d between two parts of
// the sheet, or between the sheet and an instrument, and the energy strength * range * B((d -
// radius) / range).
#pragma once

#include <span>
#include <vector>

#include "energy/hessian_assembler.h"
#include "energy/term.h"
#include "geometry/distance.h"

namespace mvs::core {

// The barrier with its first and second derivative.
struct Barrier {
  double value, first, second;
};
Barrier barrier(double s);
// (1 - s)^3 scaled to push as the barrier does at s = 1/2.
Barrier penalty(double s);

// Two features within range: d = |sum_k weight_k x_k| over up to four nodes.
struct ContactPair {
  std::array<uint32_t, 4> node;
  std::array<double, 4> weight;
  std::array<std::array<double, 4>, 2> slide;  // d(weight) along each direction of sliding
  uint32_t count;                              // nodes
  uint32_t slides;                             // 0: point-point, 1: point-edge, 2: face or edges
  Vec3 normal;                                 // unit, towards the first nodes
  double distance;
  double range;
  double strength;    // kappa times an area, times c_p: may be negative
  bool is_barrier;    // of the short-range barrier, not of contact proper
  double radius = 0;  // m, of the instrument; 0 between parts of the sheet

  double gap() const { return distance - radius; }
  std::span<const uint32_t> nodes() const { return {node.data(), count}; }
};

// Pairs without distance, range and strength. The nodes of the second feature follow the first.
ContactPair point_point(uint32_t v, uint32_t a);
ContactPair point_edge(uint32_t v, uint32_t a, uint32_t b, double s);
ContactPair point_face(uint32_t v, const Tri &t, const std::array<double, 3> &weight);
// A vertex and the feature of a triangle that is closest to it.
ContactPair vertex_triangle(uint32_t v, const Tri &t, const TrianglePoint &p);
ContactPair edge_edge(const Edge &e, const Edge &f, const SegmentPair &p);

// Measures the distance and normal at x. Returns false if the pair is out of range.
bool measure(const std::vector<Vec3> &x, ContactPair &s);

// Sums over contact pairs, at the positions where they were measured.
double energy_of(const std::vector<ContactPair> &contact_pairs, Barrier (*curve)(double));
// The energies of pairs first .. last.
void energies_of(const std::vector<ContactPair> &contact_pairs, Barrier (*curve)(double),
                 size_t first, size_t last, double *to);
double add_gradient(const std::vector<ContactPair> &contact_pairs, Barrier (*curve)(double),
                    std::vector<Vec3> &g);
// To a WholeGradient or a PartGradient.
template <typename Gradient>
void add_gradient(const std::vector<ContactPair> &contact_pairs, Barrier (*curve)(double),
                  Gradient &to);
// Adds to a HessianAssembler or a HessianPart. Returns false if the pattern lacks a block;
// add_pairs() returns the pairs of nodes it needs.
template <typename Assembler>
bool add_hessian(const std::vector<ContactPair> &contact_pairs, Barrier (*curve)(double),
                 const std::vector<Vec3> &x, Curvature curvature, Assembler &assembler);
void add_pairs(const std::vector<ContactPair> &contact_pairs, std::vector<Edge> &pairs);

}  // namespace mvs::core
