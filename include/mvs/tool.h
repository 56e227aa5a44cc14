/* Instruments in the valve: grasp and pull tissue, push it aside, read the reaction force.
 *
 * A tool belongs to the state, not to the valve: it is part of snapshots, their hash and HDF5
 * files; plans replay its motion. Undo, restore and checkpoints return to the tools of that state,
 * with their hands where they were then. A tool that was removed since then returns, and pulls
 * again until it is removed again. A tool that was added since then disappears. mvs_device_sync
 * removes tools of its device that returned without a hand. A spring couples the hand to the tool
 * and saturates at `max_force`: the tissue acts on the hand with the force of this spring, at most
 * `max_force` at any distance of the hand.
 *
 * A tool that pushes never passes through a leaflet, and no leaflet through it: where tissue blocks
 * it, the tool (its proxy) stays behind the hand. Chordae do not touch a ball or rod. Tools act in
 * mvs_settle and mvs_step; MVS_SOLVER_EXPLICIT, which does not prevent crossing, accepts grasps
 * only.
 *
 * A convex tool is a union of rounded convex bodies: a hook, closed forceps, a plate, a sizer. It
 * has an orientation, and chordae touch it as capsules of their own cross-section. Springs couple
 * its position and its orientation to the hand; the springs of both saturate together. It is
 * slightly elastic: `max_force` of 5 N stretches it by about 1 %. A proxy turns by less than 20
 * degrees in a step and lags behind a hand that turns fast, by half a step at 10 rad/s; a hand
 * that turns by more than 90 degrees between two steps may leave it turned the other way.
 *
 * libmvs computes the distances of a convex tool itself; the tests of the source tree compare them
 * with those of libccd. Forces use a smoothed distance, 0.8 to 1.34 times the true one. The true
 * one limits motion and refuses tools inside tissue. The stitches of a clip touch it as
 * chordae of the suture's thickness; a ring has no thickness, and a tool meets the annulus that
 * lies on it. */
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
  MVS_TOOL_KIND_ROD = 3,   /* pushes with a rod with round ends, from its tip along its axis */
  MVS_TOOL_KIND_CONVEX = 4 /* pushes with rounded convex bodies */
};
typedef uint32_t mvs_tool_kind;

/* Kinds of bodies of a convex tool. */
enum mvs_body_kind_e {
  MVS_BODY_KIND_HULL = 1,     /* the convex hull of vertices */
  MVS_BODY_KIND_BALL = 2,     /* around `position` */
  MVS_BODY_KIND_CAPSULE = 3,  /* around the segment from `position` to `end` */
  MVS_BODY_KIND_BOX = 4,      /* around `position`, turned by `orientation` */
  MVS_BODY_KIND_CYLINDER = 5, /* from `position` to `end` */
  MVS_BODY_KIND_CONE = 6      /* with its base around `position` and its apex at `end` */
};
typedef uint32_t mvs_body_kind;

/* Largest numbers of bodies of a tool, and of vertices of all of them together. */
#define MVS_MAX_BODIES 16
#define MVS_MAX_BODY_VERTICES 2048
/* Vertices of each circle of a cylinder or cone: a regular polygon whose corners lie on the circle,
 * so that its sides lie up to 0.9 % of its radius inside. */
#define MVS_BODY_CIRCLE_VERTICES 24

/* A body of a convex tool, in the frame of the hand: the origin is the hand's `position`, the axes
 * turn with its `orientation`. Every coordinate is within 0.3 m. */
typedef struct mvs_body_desc {
  mvs_body_kind kind; /* MVS_BODY_KIND_* */
  uint32_t reserved;
  mvs_array vertices;    /* n x 3: m, of a hull, at least 4, not all near one plane */
  double position[3];    /* m */
  double end[3];         /* m */
  double size[3];        /* m, edges of a box; size[0]: radius of the circles of a cylinder or cone;
                            1e-4 to 0.3 */
  double orientation[4]; /* of a box, w x y z of a quaternion of any length; all 0: the hand's */
  double radius; /* m, of a ball or capsule 1e-4 to 0.02 [2e-3]; of others, by which they are
                    rounded outwards, 0 to 0.02 */
} mvs_body_desc;

/* A new tool; kind and position are required. */
typedef struct mvs_tool_desc {
  uint32_t struct_size;
  mvs_tool_kind kind; /* MVS_TOOL_KIND_* */
  double position[3]; /* m, of the hand: centre of the ball, of the tip's round end, of the grip,
                         origin of the bodies */
  double axis[3];     /* of a rod, from its tip to its handle, any length [0, 0, 1] */
  double radius;      /* m, of a ball or rod; 1e-4 to 0.02 [2e-3] */
  double length;      /* m, of a rod between the centres of its ends; 1e-3 to 0.3 [40e-3] */
  double stiffness;   /* N/m, of the spring between hand and tool; 1 to 1e5 [200]; a rod has half
                         of it at each end, a convex tool a quarter at each point of its frame */
  double max_force;   /* N, of that spring; 1e-3 to 100 [5]; a rod has half of it at each end, a
                         convex tool a quarter at each point of its frame */
  double reach;       /* m; a grasp takes the nearest free vertex of a leaflet within it [2e-3] */
  uint32_t by_node; /* 1: a grasp takes `node`, a leaflet vertex or branch point, at any distance */
  uint32_t node;    /* with by_node */
  const mvs_body_desc *bodies; /* of a convex tool, 1 to MVS_MAX_BODIES */
  uint32_t body_count;
  uint32_t body_stride;  /* sizeof(mvs_body_desc) */
  double orientation[4]; /* of a convex tool, w x y z of a quaternion of any length [1 0 0 0] */
  uint32_t strict_hulls; /* 1: refuses a hull with vertices that are no corners of it; 0: drops them
                            and logs a warning */
  uint32_t reserved;     /* 0 */
} mvs_tool_desc;

/* Largest number of tools of a valve. */
#define MVS_MAX_TOOLS 64

/* Adds a tool to the state; *tool is its id, unique for this valve. The spring of a grasp has no
 * rest length: a node 5 mm from the hand is pulled with 1 N (200 N/m) from the first step on. Add
 * it with `position` at the node, and move the hand from there, to begin without force.
 * MVS_E_ARGUMENT if a value is out of its range, no node is within reach, or a tool that pushes is
 * farther from the middle of the valve than ten times its size; MVS_E_STATE if a tool that pushes
 * would overlap tissue, or there are MVS_MAX_TOOLS. */
MVS_API mvs_result mvs_add_tool(mvs_sim *sim, const mvs_tool_desc *desc, mvs_id *tool);

/* Moves the hand of a tool. The next mvs_settle or mvs_step starts with the last position of each
 * hand; until then snapshots show the previous one. From any thread, also during a call on the
 * simulator. `axis` is nullable: unchanged; tools other than rods ignore it. MVS_E_ID if the tool
 * does not exist; MVS_E_ARGUMENT if a coordinate is not within 10 m, or an axis has no length.
 * mvs_restore and a new valve discard a move that no settle or step has used; mvs_undo keeps it.
 * The history records the motion of hands for plans: 30 bytes of memory for each step of a hand
 * that moved (27 MB an hour at 250 steps a second), 33 bytes in a plan; a resting hand adds
 * nothing. A tool that is added and removed takes 840 bytes of memory. */
MVS_API mvs_result mvs_move_tool(mvs_sim *sim, mvs_id tool, const double position[3],
                                 const double axis[3]);

/* The same with an orientation, w x y z of a quaternion of any length but 0, of a convex tool; a
 * rod takes the z axis that it turns to, others have none. `orientation` is nullable: unchanged. */
MVS_API mvs_result mvs_move_tool_pose(mvs_sim *sim, mvs_id tool, const double position[3],
                                      const double orientation[4]);

/* Removes a tool from the state; a grasp releases its node. MVS_E_ID if it does not exist. */
MVS_API mvs_result mvs_remove_tool(mvs_sim *sim, mvs_id tool);

/* A tool in a snapshot. */
typedef struct mvs_tool_state {
  uint32_t struct_size;
  mvs_tool_kind kind;
  mvs_id id;
  double position[3];    /* m, of the hand */
  double axis[3];        /* of the hand's rod, of length 1; 0 for others */
  double proxy[3];       /* m, of the tool: the held node, the centre of ball or tip */
  double proxy_axis[3];  /* of the rod, of length 1; 0 for others */
  double force[3];       /* N, on the hand */
  double torque[3];      /* N m, on the hand about `position`, of a rod or convex tool */
  double distance;       /* m, from the surface of a tool that pushes to the mid-surface of the
                            nearest leaflet, of a convex tool also to the surface of a chord;
                            infinity without leaflets, 0 for a grasp */
  double radius, length; /* m; length of a convex tool: the arm of its frame */
  double stiffness, max_force; /* N/m, N: of the spring between hand and tool */
  uint32_t node;               /* held by a grasp; UINT32_MAX for others */
  uint32_t touching;           /* 1: tissue acts on it; always 1 for a grasp */
  double orientation[4];       /* of the hand of a convex tool, w x y z of length 1; 0 for others */
  double proxy_orientation[4]; /* of the convex tool, whose origin is `proxy` */
  uint32_t body_count;         /* of a convex tool */
  uint32_t vertex_count;       /* of all its bodies */
} mvs_tool_state;

/* A body of a convex tool: the hull of `vertices`, rounded by `radius`. */
typedef struct mvs_tool_body {
  uint32_t struct_size;
  mvs_body_kind kind; /* as it was given */
  double radius;      /* m */
  mvs_view vertices;  /* m, 3 x MVS_TYPE_F64, in the frame of the hand */
  mvs_view triangles; /* 3 x MVS_TYPE_U32, of the surface of the hull with outward normals; none for
                         a ball or capsule */
} mvs_tool_body;

/* Reads a tool of the present snapshot by its id, from any thread; MVS_E_ID if it does not exist.
 */
MVS_API mvs_result mvs_get_tool(const mvs_sim *sim, mvs_id tool, mvs_tool_state *state);

/* The tools of a snapshot in the order of their addition. */
MVS_API mvs_result mvs_snapshot_get_tool_count(const mvs_snapshot *snapshot, uint32_t *count);
MVS_API mvs_result mvs_snapshot_get_tool(const mvs_snapshot *snapshot, uint32_t index,
                                         mvs_tool_state *state);

/* Body `body` of tool `index` of a snapshot; its views are valid while the snapshot is held. */
MVS_API mvs_result mvs_snapshot_get_tool_body(const mvs_snapshot *snapshot, uint32_t index,
                                              uint32_t body, mvs_tool_body *out);

#ifdef __cplusplus
}
#endif
#endif
