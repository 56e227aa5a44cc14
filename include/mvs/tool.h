/* Instruments in the valve: grasp and pull tissue, push it aside, read the reaction force.
 *
 * A tool belongs to the state, not to the valve: it is part of snapshots, their hash and HDF5
 * files; undo and restore bring it back; plans replay its motion. A spring couples the hand to the
 * tool and saturates at `max_force`: the tissue acts on the hand with the force of this spring, at
 * most `max_force` at any distance of the hand.
 *
 * A ball or rod never passes through a leaflet, and no leaflet through it: where tissue blocks it,
 * the tool (its proxy) stays behind the hand. Chordae do not touch it. Tools act in mvs_settle and
 * mvs_step; MVS_SOLVER_EXPLICIT, which does not prevent crossing, accepts grasps only. */
#ifndef MVS_TOOL_H
#define MVS_TOOL_H

#include "base.h"
#include "sim.h"
#include "snapshot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Kinds of tools. */
enum mvs_tool_kind_e {
  MVS_TOOL_KIND_GRASP = 1, /* holds a node */
  MVS_TOOL_KIND_BALL = 2,  /* pushes with a ball */
  MVS_TOOL_KIND_ROD = 3    /* pushes with a rod with round ends, from its tip along its axis */
};
typedef uint32_t mvs_tool_kind;

/* A new tool; kind and position are required. */
typedef struct mvs_tool_desc {
  uint32_t struct_size;
  mvs_tool_kind kind; /* MVS_TOOL_KIND_* */
  double position[3]; /* m, of the hand: centre of the ball, of the tip's round end, of the grip */
  double axis[3];     /* of a rod, from its tip to its handle, any length [0, 0, 1] */
  double radius;      /* m, of a ball or rod; 1e-4 to 0.02 [2e-3] */
  double length;      /* m, of a rod between the centres of its ends; 1e-3 to 0.3 [40e-3] */
  double stiffness;   /* N/m, of the spring between hand and tool; 1 to 1e5 [200]; a rod has half
                         of it at each end */
  double max_force;   /* N, of that spring; 1e-3 to 100 [5]; a rod has half of it at each end */
  double reach;       /* m; a grasp takes the nearest free vertex of a leaflet within it [2e-3] */
  uint32_t by_node; /* 1: a grasp takes `node`, a leaflet vertex or branch point, at any distance */
  uint32_t node;
} mvs_tool_desc;

/* Largest number of tools of a valve. */
#define MVS_MAX_TOOLS 64

/* Adds a tool to the state; *tool is its id, unique for this valve. The spring of a grasp starts
 * with the present distance of hand and node. MVS_E_ARGUMENT if a value is out of its range or no
 * node is within reach; MVS_E_STATE if a ball or rod would overlap tissue, or there are
 * MVS_MAX_TOOLS. */
MVS_API mvs_result mvs_add_tool(mvs_sim *sim, const mvs_tool_desc *desc, mvs_id *tool);

/* Moves the hand of a tool. The next mvs_settle or mvs_step starts with the last position of each
 * hand; until then snapshots show the previous one. From any thread, also during a call on the
 * simulator. `axis` is nullable: unchanged; only rods have an axis. MVS_E_ID if the tool does not
 * exist. mvs_restore and a new valve discard a move that no settle or step has used.
 * The history records the motion of hands for plans: 30 bytes of memory for each step of a hand
 * that moved (27 MB an hour at 250 steps a second), 33 bytes in a plan; a resting hand adds
 * nothing. */
MVS_API mvs_result mvs_move_tool(mvs_sim *sim, mvs_id tool, const double position[3],
                                 const double axis[3]);

/* Removes a tool from the state; a grasp releases its node. */
MVS_API mvs_result mvs_remove_tool(mvs_sim *sim, mvs_id tool);

/* A tool in a snapshot. */
typedef struct mvs_tool_state {
  uint32_t struct_size;
  mvs_tool_kind kind;
  mvs_id id;
  double position[3];   /* m, of the hand */
  double axis[3];       /* of the hand's rod, of length 1; 0 for others */
  double proxy[3];      /* m, of the tool: the held node, the centre of ball or tip */
  double proxy_axis[3]; /* of the rod, of length 1; 0 for others */
  double force[3];      /* N, on the hand */
  double torque[3];     /* N m, on the hand about `position`, of a rod */
  double distance;      /* m, from the surface of a ball or rod to the mid-surface of the
                           nearest leaflet; infinity without leaflets, 0 for a grasp */
  double radius, length, stiffness, max_force;
  uint32_t node;     /* held by a grasp; UINT32_MAX for others */
  uint32_t touching; /* 1: tissue acts on it; always 1 for a grasp */
} mvs_tool_state;

/* Reads a tool of the present snapshot by its id, from any thread; MVS_E_ID if it does not exist.
 */
MVS_API mvs_result mvs_get_tool(const mvs_sim *sim, mvs_id tool, mvs_tool_state *state);

/* The tools of a snapshot in the order of their addition. */
MVS_API mvs_result mvs_snapshot_get_tool_count(const mvs_snapshot *snapshot, uint32_t *count);
MVS_API mvs_result mvs_snapshot_get_tool(const mvs_snapshot *snapshot, uint32_t index,
                                         mvs_tool_state *state);

#ifdef __cplusplus
}
#endif
#endif
