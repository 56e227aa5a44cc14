/* Instruments in the valve: hold tissue and pull it, push it aside, feel what it answers.
 *
 * A tool belongs to the state, not to the valve: it is in snapshots, their hash and HDF5 files,
 * undo and restore bring it back as it was, plans replay what was done with it. The hand that
 * leads it is tied to it by a spring that gives way at `max_force`: what is held or pushed answers
 * with the same force, at most that, however far the hand goes.
 *
 * A ball or rod never passes through a leaflet, and no leaflet through it: where tissue is in the
 * way the tool (its proxy) stays behind the hand. Chordae do not feel it. Tools act in mvs_settle
 * and mvs_step; MVS_SOLVER_EXPLICIT, which guards against no crossing, takes grasps only. */
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
  MVS_TOOL_KIND_ROD = 3    /* pushes with a rod of round ends, from its tip along its axis */
};
typedef uint32_t mvs_tool_kind;

/* A new tool. Zero fields take the defaults in brackets; a kind and a position must be given. */
typedef struct mvs_tool_desc {
  uint32_t struct_size;
  uint32_t kind;      /* MVS_TOOL_KIND_* */
  double position[3]; /* m, of the hand: middle of the ball, of the tip's round end, of the grip */
  double axis[3];     /* of a rod, from its tip to its handle, any length [0, 0, 1] */
  double radius;      /* m, of a ball or rod; 1e-4 to 0.02 [2e-3] */
  double length;      /* m, of a rod between the middles of its ends; 1e-3 to 0.3 [40e-3] */
  double stiffness;   /* N/m, of the spring between hand and tool; 1 to 1e5 [200]; of a rod half of
                         it at each end */
  double max_force;   /* N, of that spring; 1e-3 to 100 [5]; of a rod half of it at each end */
  double reach;       /* m; a grasp takes the nearest free vertex of a leaflet within it [2e-3] */
  uint32_t by_node;   /* 1: a grasp takes `node`, a leaflet's or a branch point, from anywhere */
  uint32_t node;
} mvs_tool_desc;

/* The most tools that a valve can have at a time. */
#define MVS_MAX_TOOLS 64

/* Adds a tool to the state; *tool is its id, which no other tool of this valve ever gets. A grasp
 * starts with its spring as the hand and the node lie. MVS_E_ARGUMENT where a value is out of its
 * range, or nothing is in reach; MVS_E_STATE where a ball or rod would lie in tissue, or there are
 * too many. */
MVS_API mvs_result mvs_add_tool(mvs_sim *sim, const mvs_tool_desc *desc, mvs_id *tool);

/* Moves the hand of a tool. The next mvs_settle or mvs_step begins with the last such move of each
 * tool; until then snapshots have the tool where it was. From any thread, also while the simulator
 * is at work. `axis` is nullable: as before; others than rods have none. MVS_E_ID if the tool is
 * not there (any more). A move that no settle or step has begun with is forgotten by mvs_restore
 * and with the valve.
 * What hands did stays in the history, so that plans can do it again: 30 bytes of memory for each
 * step of a hand that moved (27 MB an hour at 250 a second), 33 in a plan; none while it rests. */
MVS_API mvs_result mvs_move_tool(mvs_sim *sim, mvs_id tool, const double position[3],
                                 const double axis[3]);

/* Takes a tool out of the state: lets go of what it holds. */
MVS_API mvs_result mvs_remove_tool(mvs_sim *sim, mvs_id tool);

/* A tool as it is in a snapshot. */
typedef struct mvs_tool_state {
  uint32_t struct_size;
  uint32_t kind;
  mvs_id id;
  double position[3];   /* m, of the hand */
  double axis[3];       /* of the hand's rod, of length 1; 0 for others */
  double proxy[3];      /* m, where the tool is: the held node, the middle of ball or tip */
  double proxy_axis[3]; /* of the rod, of length 1; 0 for others */
  double force[3];      /* N, on the hand */
  double torque[3];     /* N m, on the hand about `position`, of a rod */
  double distance;      /* m, from the surface of a ball or rod to the middle of the nearest
                           leaflet; infinity without leaflets, 0 for a grasp */
  double radius, length, stiffness, max_force;
  uint32_t node;     /* held by a grasp; UINT32_MAX for others */
  uint32_t touching; /* 1: tissue pushes on it; always of a grasp */
} mvs_tool_state;

/* A tool of the present snapshot by its id, from any thread; MVS_E_ID if it is not there. */
MVS_API mvs_result mvs_get_tool(const mvs_sim *sim, mvs_id tool, mvs_tool_state *state);

/* The tools of a snapshot, in the order in which they were added. */
MVS_API mvs_result mvs_snapshot_get_tool_count(const mvs_snapshot *snapshot, uint32_t *count);
MVS_API mvs_result mvs_snapshot_get_tool(const mvs_snapshot *snapshot, uint32_t index,
                                         mvs_tool_state *state);

#ifdef __cplusplus
}
#endif
#endif
