// Local tissue models of grasps, balls, rods and chordae.
#include "haptics/tissue_model_builder.h"

#include <cmath>

#include "geometry/distance.h"
#include "model/chord_law.h"
#include "model/model.h"

namespace mvs::core {
namespace {

constexpr double same_place = 0.5e-3;  // m, motion of the tool within which its stiffness is reused
constexpr uint32_t refresh_calls = 32;  // a stiffness is reused for at most this many calls...
constexpr uint32_t least_calls = 8;     // ...and, within one contact, for at least this many

// Returns the point of the axis of a rod that is nearest to the leaflets, as its share of the
// length.
double nearest_on_axis(const Model &model, const std::vector<Vec3> &x, const Tool &tool) {
  const Vec3 &a = tool.proxy[0], &b = tool.proxy[1];
  double least = std::numeric_limits<double>::infinity(), share = 0;
  const auto take = [&](double distance2, double at) {
    if (distance2 < least) share = at;
    least = std::min(least, distance2);
  };
  for (const Tri &t : model.valve.triangles) {
    const Vec3 &p = x[t[0]], &q = x[t[1]], &r = x[t[2]];
    take(closest_on_triangle(a, p, q, r).distance2, 0);
    take(closest_on_triangle(b, p, q, r).distance2, 1);
    for (uint32_t k = 0; k < 3; ++k) {
      const SegmentPair pair = closest_of_segments(a, b, x[t[k]], x[t[(k + 1) % 3]]);
      take(pair.distance2, pair.s);
    }
  }
  return share;
}

// The shortest turn from one direction to another, half a turn about any normal of opposite ones.
// (Eigen's own compiles a singular value decomposition for those.)
Eigen::Quaterniond shortest_turn(const Vec3 &from, const Vec3 &to) {
  const Vec3 a = from.normalized(), b = to.normalized();
  const double cosine = a.dot(b);
  if (cosine <= -1 + 1e-12) {  // the cross product is rounding there
    const Vec3 other = std::abs(a.x()) < 0.5 ? Vec3::UnitX() : Vec3::UnitY();
    const Vec3 normal = a.cross(other).normalized();
    return {0, normal.x(), normal.y(), normal.z()};
  }
  const double twice = std::sqrt((1 + cosine) * 2);  // of the cosine of half the angle
  const Vec3 axis = a.cross(b) * (1 / twice);
  return {twice * 0.5, axis.x(), axis.y(), axis.z()};
}

// Returns the orientation of the hand when the tool moved last. A convex tool keeps it; of a rod it
// is the present one, turned to the rod's axis by the shortest way: rotation about the axis changes
// nothing.
Eigen::Quaterniond orientation_of(const Tool &tool, const Eigen::Quaterniond &hand) {
  if (tool.kind == ToolKind::convex) {
    const Quaternion q = quaternion_of(tool.axis);
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  }
  return shortest_turn(hand * Vec3::UnitZ(), tool.axis) * hand;
}

}  // namespace

TissueModel TissueModelBuilder::next(uint32_t kind) const {
  TissueModel tissue;
  tissue.kind = kind;
  tissue.contact = contact_;
  return tissue;
}

// The far end of a rod moves by its length times the change of its axis, a point of a convex tool's
// frame by about twice that of its Rodrigues vector, half of the angle.
bool TissueModelBuilder::needs_stiffness(const Model &model, const Tool &tool) {
  const double per_axis = tool.length * (tool.kind == ToolKind::convex ? 2 : 1);
  const double moved =
      (tool.position - at_).norm() + (turns_ ? per_axis * (tool.axis - axis_).norm() : 0);
  const bool serves = age_ > 0 && valve_ == model.serial &&
                      (moved <= same_place || age_ > refresh_calls - least_calls);
  age_ = serves ? age_ - 1 : refresh_calls;
  return !serves;
}

void TissueModelBuilder::refresh_stiffness(const Model &model, const State &state, const Tool &tool,
                                           bool turns) {
  if (turns != turns_) age_ = 0;
  turns_ = turns;
  if (!needs_stiffness(model, tool)) return;
  stiffness_ = {};
  if (turns) {
    stiffness_ = feel_.wrench_stiffness(model, state, tool);
  } else {
    stiffness_.linear = feel_.stiffness(model, state, tool);
  }
  at_ = tool.position;
  axis_ = tool.axis;
  valve_ = model.serial;
}

// A ball or rod without contact gets no stiffness, only the plane of the nearest tissue.
TissueModel TissueModelBuilder::of_tool(const Model &model, const State &state, const Tool &tool,
                                        const Eigen::Quaterniond *orientation) {
  const bool grasp = tool.kind == ToolKind::grasp;
  const Room room = grasp ? Room{0, Vec3::Zero()} : room_of(model, state.x, tool);
  const bool touches = grasp || room.distance < tool_range(model);
  TissueModel tissue = next(grasp     ? TissueModel::held
                            : touches ? TissueModel::touched
                                      : TissueModel::near);
  tissue.origin = tool.position;
  tissue.most = tool.max_force;
  const bool turns = orientation && has_torque(tool);
  if (turns) {
    tissue.turns = 1;
    tissue.orientation = orientation_of(tool, *orientation);
    tissue.lever = tool.length;
    // of the springs at their largest force: half of it at the far end of a rod, a quarter at each
    // of the four points of a convex tool
    tissue.most_torque = (tool.kind == ToolKind::rod ? 0.5 : 1) * tool.max_force * tool.length;
  }
  if (touches) {
    refresh_stiffness(model, state, tool, turns);
    const ToolForce felt = force_of(state, tool);
    tissue.force = felt.force;
    tissue.stiffness = stiffness_.linear;
    if (!turns) return tissue;
    tissue.torque = felt.torque;
    tissue.coupling = stiffness_.coupling;
    tissue.turning = stiffness_.angular;
    return tissue;
  }
  age_ = 0;
  if (room.away.isZero(0)) return nothing();
  tissue.normal = room.away;
  tissue.gap = room.distance - tool_range(model);
  tissue.stiffness = tool.stiffness * Mat3::Identity();
  // a convex tool turns the hand only once it touches
  if (turns && tool.kind == ToolKind::rod)
    tissue.arm = nearest_on_axis(model, state.x, tool) * tool.length * tool.axis;
  return tissue;
}

TissueModel TissueModelBuilder::of_chord(const Model &model, const State &state, const Chord &chord,
                                         const Vec3 &hand, double gain) const {
  TissueModel tissue = next(TissueModel::pulled);
  const Vec3 d = state.x[chord.a] - state.x[chord.b];
  const double length = d.norm(), strain = length / chord.rest_length - 1;
  tissue.origin = hand;
  if (strain > 0) {
    const double tension = chord.area * chord_response(model.valve, chord, strain).stress;
    tissue.force = (gain * tension / length) * d;
  }
  tissue.most = tissue.force.norm();
  return tissue;
}

}  // namespace mvs::core
