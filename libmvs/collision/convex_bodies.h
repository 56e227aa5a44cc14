// Broad phase of convex tools, and the planes that keep them apart from tissue during a step.
//
// A part of the tissue is a triangle of the sheet or a chord. Each pair of a body and a part near
// it has a plane normal to the line between their closest points (geometry/convex_distance.h),
// confirmed by the products of all vertices with its normal: nothing else decides whether a motion
// is allowed. The points of the frame of a tool move together, so that the body stays an affine
// image of itself and each of its vertices moves along a straight line.
#pragma once

#include <vector>

#include "geometry/aabb.h"
#include "geometry/convex_hull.h"
#include "model/model.h"

namespace mvs::core {

// A body and a part: the body's vertices, moving with the frame's whole step, come nearer to the
// plane by at most `body_approach`; the nodes of the part by normal * dx.
struct BodyPair {
  uint32_t frame;                // first node of the tool's frame
  std::array<uint32_t, 3> node;  // of the part; the last one twice for a chord
  Vec3 normal;                   // unit, from the part to the body
  double gap;                    // m, between the planes that touch them
  double radius;                 // m, that has to remain
  double body_approach;          // m
};

// A body with the tissue near it.
struct ConvexBody {
  uint32_t index;  // among the bodies of its tool
  double radius;   // m
  std::vector<uint32_t> vertices, triangles, chords;
  HullEdges edges;
};

// A convex tool: its frame is the nodes from `frame` on.
struct ConvexInstrument {
  Tool tool;
  uint32_t frame;
  std::vector<ConvexBody> bodies;
};

class ConvexBodies {
 public:
  explicit ConvexBodies(const Model &model) : model_(&model) {}

  // Returns whether a tool is new, so that prepare() has to be called.
  bool set_tools(const std::vector<Tool> &tools, uint32_t first);
  const std::vector<ConvexInstrument> &all() const { return instruments_; }

  // See InstrumentBodies.
  void prepare(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack);
  const std::vector<BodyPair> &barrier_pairs(const std::vector<Vec3> &x,
                                             const std::vector<Vec3> &dx);
  void shorten(std::vector<Vec3> &step, double longest) const;
  // Shortens the step of each frame so that it cannot turn inside out; returns the least factor.
  double keep_upright(std::vector<Vec3> &dx) const;

 private:
  void find_near(const ConvexInstrument &instrument, ConvexBody &body, const std::vector<Vec3> &x,
                 const std::vector<Vec3> &to, double slack);
  void add_pair(uint32_t frame, const HullEdges &edges, std::span<const uint32_t> part,
                double radius, const std::vector<Vec3> &x, const std::vector<Vec3> &dx);

  // m, by which the body at hand comes nearer to a plane normal to this direction, at least 0.
  double approach_along(const Vec3 &normal) const;

  const Model *model_;
  std::vector<ConvexInstrument> instruments_;
  std::vector<BodyPair> pairs_;
  std::vector<Vec3> vertices_, motion_;  // of the body at hand
  Aabb box_;                             // of vertices_
  double longest_ = 0;                   // m, of motion_
  std::vector<uint8_t> outside_;         // as in InstrumentBodies
};

}  // namespace mvs::core
