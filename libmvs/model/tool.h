// Instruments in the valve, a part of the state; include/mvs/tool.h describes their behaviour.
#pragma once

#include <array>
#include <span>

#include "base/types.h"
#include "model/kinds.h"
#include "model/tool_shape.h"

namespace mvs::core {

struct Chord;
struct Model;
struct State;

struct Tool {
  Id id = 0;
  ToolKind kind = ToolKind::grasp;
  uint32_t node = none;          // held by a grasp
  double radius = 0;             // m, of a ball or rod
  double length = 0;             // m, of a rod; the arm of a convex tool
  double stiffness = 0;          // N/m
  double max_force = 0;          // N
  Vec3 position = Vec3::Zero();  // of the hand
  Vec3 axis =
      Vec3::Zero();    // of the hand: direction of a rod, Rodrigues parameters of a convex tool
  ToolShapePtr shape;  // of a convex tool
  // Actual position: centre of a ball, both ends of a rod, the frame of a convex tool; unused by a
  // grasp.
  std::array<Vec3, frame_points> proxy = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};

  // Number of its own degrees of freedom, as points.
  uint32_t points() const {
    return kind == ToolKind::convex ? frame_points : static_cast<uint32_t>(kind) - 1;
  }
  // Position that the hand requests for point k.
  Vec3 target(uint32_t k) const {
    if (kind == ToolKind::convex) return position + length * (rotation_of(axis) * frame_corner(k));
    return position + k * length * axis;
  }

  // Whether both are the same tool, regardless of position. Comparing ids is not sufficient: after
  // an undo, the next tool gets the id of the undone one.
  bool is_same_as(const Tool &other) const {
    return id == other.id && kind == other.kind && radius == other.radius &&
           length == other.length && shape == other.shape;
  }
  bool operator==(const Tool &) const = default;
};

// Ids of tools are larger than the ids of all parts of a valve.
inline constexpr Id first_tool_id = Id{1} << 48;

// Returns the distance from the mid-surface of the leaflets to the surface of a tool that pushes;
// negative inside it, infinity without leaflets. A convex tool counts chordae too, from their
// surface; stitches of clips are chordae.
double clearance(const Model &model, const std::vector<Vec3> &x, const Tool &tool);

// The same distance with the unit direction from the nearest tissue to the tool; 0 without
// leaflets.
struct Room {
  double distance;
  Vec3 away;
};
Room room_of(const Model &model, const std::vector<Vec3> &x, const Tool &tool);

// Returns the distance from the mid-surface below which tissue pushes: half of the contact
// thickness.
double tool_range(const Model &model);

// m, radius of the round cross-section of a chord.
double chord_radius(const Chord &chord);

// Positions of the vertices of a body of a convex tool whose frame is at `frame`.
void place_body(const ToolShape &shape, size_t body, std::span<const Vec3> frame,
                std::vector<Vec3> &vertices);

// Adds a tool at the position of its hand and assigns an id. Throws if the position is not
// possible.
Id add_tool(const Model &model, State &state, Tool tool);

// Returns whether a tool from a file is one that add_tool could have made for this model: its kind
// is known, a grasp holds a free node, stiffness and force limit are positive.
bool is_valid(const Model &model, const Tool &tool);

// These throw MVS_E_ID if the tool does not exist, with the name of the call.
const Tool &tool_of(const State &state, Id id, const char *call);
void move_tool(State &state, Id id, const Vec3 &position, const Vec3 &axis);
void remove_tool(State &state, Id id);

// After an operation: renumbers grasped nodes, and removes tools whose node or free space is gone.
// `number` gives the new number of each node.
void renumber_grasps(State &state, const std::vector<uint32_t> &number);
void drop_lost_tools(const Model &model, State &state);

}  // namespace mvs::core
