// Contact of convex tools with the sheet and with chordae, and the springs that keep their frames.
//
// The sheet: as for a ball (energy/instrument.h), with the distance to the hull of the body's
// vertices less its rounding radius R. Each vertex of the sheet has the energy kappa A_v r B((d -
// R) / r), r half of the contact thickness, so that a pressure acts at a distance, at any mesh
// size; the distance to a convex body has a continuous derivative, so that this force is continuous
// as tissue slides over faces, edges and corners. Each triangle has the short-range barrier
// (kappa A / 6 + F / 10) r_b B((d - R) / r_b), F the force limit of the hand, with its distance to
// the body, so that corners and edges of the body are held between vertices. The distance d - R of
// a triangle or chord is the smooth one of geometry/smooth_distance.h: the force is continuous,
// with its point of attack, also where a facet or edge of the body passes through being parallel to
// tissue.
//
// A chord is a capsule of its own radius R_c: kappa A_c r B((d - R - R_c) / r), A_c the area of a
// strip of its diameter along half of its rest length.
//
// Six axial springs of equal stiffness along the edges of its tetrahedron keep a frame rigid. There
// is no friction.
#pragma once

#include <vector>

#include "collision/convex_bodies.h"
#include "energy/barrier.h"
#include "geometry/aabb.h"
#include "geometry/smooth_distance.h"
#include "model/model.h"

namespace mvs::core {

// A body and a part of the tissue within range: d = |sum_k weight_k x_k| over the nodes of the part
// and of the frame. The corners of the difference of both hulls that the closest points lie between
// give the directions of sliding.
struct BodyContact {
  static constexpr uint32_t most_nodes = 3 + frame_points;
  using Weights = std::array<double, most_nodes>;
  std::array<uint32_t, most_nodes> node;
  Weights weight;
  static constexpr uint32_t most_slides = SmoothDistance::most_corners - 1;
  std::array<Weights, most_slides> slide;  // d(weight) along each direction of sliding
  uint32_t count;                          // nodes
  uint32_t parts;                          // of them those of the tissue, which come first
  uint32_t slides;
  Vec3 normal;  // unit, from the part to the body
  double distance, radius, range, strength;
  double factor, bend;  // of SmoothDistance

  double gap() const { return (distance - radius) / factor; }
};

class ConvexContactTerm {
 public:
  explicit ConvexContactTerm(const Model &model) : model_(&model) {}

  void collect(const std::vector<Vec3> &x, const ConvexBodies &bodies);
  const std::vector<BodyContact> &contacts() const { return contacts_; }

  // These refer to the last collect().
  double energy(const std::vector<Vec3> &x) const;
  void add_gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const;
  bool hessian(const std::vector<Vec3> &x, Curvature curvature, HessianAssembler &assembler) const;
  void add_pairs(std::vector<Edge> &pairs) const;

 private:
  // Range and strength of a kind of contact, with the distance that has to remain.
  struct Law {
    double radius, range, strength;
  };
  // The edge between two points of a frame.
  struct FrameEdge {
    Edge node;
    double length;  // m, at rest
  };
  void collect_body(const std::vector<Vec3> &x, const ConvexInstrument &instrument,
                    const ConvexBody &body);
  void take(const std::vector<Vec3> &x, const ConvexInstrument &instrument, const ConvexBody &body,
            std::span<const uint32_t> part, const Law &law);

  const Model *model_;
  std::vector<BodyContact> contacts_;
  std::vector<FrameEdge> edges_;
  std::vector<Vec3> vertices_;  // of the body at hand
  Aabb box_;                    // of them
};

}  // namespace mvs::core
