// Instruments in the valve: part of the state (include/mvs/tool.h says what they do).
#pragma once

#include <array>

#include "base/types.h"

namespace mvs::core {

struct Model;
struct State;

struct Tool {
  Id id = 0;
  uint32_t kind = 1;                                  // MVS_TOOL_KIND_*
  uint32_t node = none;                               // held by a grasp
  double radius = 0, length = 0;                      // m, of what pushes
  double stiffness = 0;                               // N/m
  double max_force = 0;                               // N
  Vec3 position = Vec3::Zero(), axis = Vec3::Zero();  // of the hand
  // Where it is: the middle of a ball, of both ends of a rod; unused by a grasp.
  std::array<Vec3, 2> proxy = {Vec3::Zero(), Vec3::Zero()};

  // How many points of its own it has.
  uint32_t points() const { return kind - 1; }
  // Where the hand wants point k.
  Vec3 target(uint32_t k) const { return position + k * length * axis; }

  // Whether it is the same thing, wherever it is. An id is not enough: what was undone gives its
  // own to the next tool.
  bool is_same_as(const Tool &other) const {
    return id == other.id && kind == other.kind && radius == other.radius && length == other.length;
  }
  bool operator==(const Tool &) const = default;
};

// Ids of tools lie above those of the parts of any valve.
inline constexpr Id first_tool_id = Id{1} << 48;

// The middle of the leaflets to the surface of a ball or rod; negative inside it, infinity without
// leaflets.
double clearance(const Model &model, const std::vector<Vec3> &x, const Tool &tool);

// The same, and the unit direction from the tissue there to the tool; 0 without leaflets.
struct Room {
  double distance;
  Vec3 away;
};
Room room_of(const Model &model, const std::vector<Vec3> &x, const Tool &tool);

// How near the middle of a leaflet tissue begins to push: half of the contact thickness.
double tool_range(const Model &model);

// Adds a tool where its hand is and gives it an id. Throws where it cannot be there.
Id add_tool(const Model &model, State &state, Tool tool);

// Whether a tool that was read from a file is one that add_tool could have made for this model: its
// kind is known, a grasp holds a free node, stiffness and force limit are positive.
bool is_valid(const Model &model, const Tool &tool);

// Throw MVS_E_ID where the tool is not there, in the name of a call.
const Tool &tool_of(const State &state, Id id, const char *call);
void move_tool(State &state, Id id, const Vec3 &position, const Vec3 &axis);
void remove_tool(State &state, Id id);

// After an operation: the tools that still have their place. `number` are the new numbers of nodes.
void renumber_grasps(State &state, const std::vector<uint32_t> &number);
void drop_lost_tools(const Model &model, State &state);

}  // namespace mvs::core
