// Kinds of nodes, parts and tools, laws and solvers. Their numbers are those of the C interface;
// files and hashes store them. A number from outside may be none of the enumerators: find_faults
// and is_valid report it.
#pragma once

#include <mvs/sim.h>
#include <mvs/snapshot.h>
#include <mvs/tool.h>
#include <mvs/valve.h>

namespace mvs::core {

// One byte, as in the array of a snapshot.
enum class NodeKind : uint8_t {
  leaflet = MVS_NODE_KIND_LEAFLET,
  annulus = MVS_NODE_KIND_ANNULUS,
  branch = MVS_NODE_KIND_BRANCH,
  head = MVS_NODE_KIND_HEAD
};

enum class ChordKind : uint32_t {
  other = MVS_CHORD_KIND_OTHER,
  marginal = MVS_CHORD_KIND_MARGINAL,
  rough_zone = MVS_CHORD_KIND_ROUGH_ZONE,
  strut = MVS_CHORD_KIND_STRUT,
  basal = MVS_CHORD_KIND_BASAL,
  commissural = MVS_CHORD_KIND_COMMISSURAL,
  trunk = MVS_CHORD_KIND_TRUNK,
  suture = MVS_CHORD_KIND_SUTURE
};

enum class RingKind : uint32_t { rigid = MVS_RING_KIND_RIGID, band = MVS_RING_KIND_BAND };

enum class ToolKind : uint32_t {
  grasp = MVS_TOOL_KIND_GRASP,
  ball = MVS_TOOL_KIND_BALL,
  rod = MVS_TOOL_KIND_ROD,
  convex = MVS_TOOL_KIND_CONVEX
};

enum class BodyKind : uint32_t {
  hull = MVS_BODY_KIND_HULL,
  ball = MVS_BODY_KIND_BALL,
  capsule = MVS_BODY_KIND_CAPSULE,
  box = MVS_BODY_KIND_BOX,
  cylinder = MVS_BODY_KIND_CYLINDER,
  cone = MVS_BODY_KIND_CONE
};

enum class LeafletLawId : uint32_t {
  spring = MVS_LEAFLET_LAW_SPRING,
  bilinear = MVS_LEAFLET_LAW_BILINEAR,
  fung = MVS_LEAFLET_LAW_FUNG,
  may_newman_yin = MVS_LEAFLET_LAW_MAY_NEWMAN_YIN,
  prot = MVS_LEAFLET_LAW_PROT,
  neo_hookean = MVS_LEAFLET_LAW_NEO_HOOKEAN
};

enum class ChordLawId : uint32_t {
  linear = MVS_CHORD_LAW_LINEAR,
  bilinear = MVS_CHORD_LAW_BILINEAR,
  ogden = MVS_CHORD_LAW_OGDEN,
  table = MVS_CHORD_LAW_TABLE
};

// Here and not in solve, because the history and plans name it too.
enum class SolverKind : uint32_t {
  unset = 0,  // newton to settle, implicit_euler to step
  newton = MVS_SOLVER_NEWTON,
  implicit_euler = MVS_SOLVER_IMPLICIT,
  explicit_euler = MVS_SOLVER_EXPLICIT
};

}  // namespace mvs::core
