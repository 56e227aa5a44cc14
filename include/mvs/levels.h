/* Mesh levels of one valve: finer ones, coarser ones, and states carried between them.
 *
 * The vertices of a coarser level are vertices of the finer one, at the same rest places bit for
 * bit, so that results of two levels can be compared node by node. MVS_ARRAY_NODE_ORIGIN tells
 * which: as after an operation it is the node's index in the valve that was set, generated or
 * loaded, and UINT32_MAX for a node that refinement added.
 *
 * The rest shape of a refined valve is the same surface of flat triangles: two closures differ by
 * what the mesh does to the solution, not by another shape. */
#ifndef MVS_LEVELS_H
#define MVS_LEVELS_H

#include "base.h"
#include "sim.h"
#include "snapshot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Replaces the valve by the next finer level: each triangle becomes four. Old nodes keep their
 * index, new ones follow. Parts, names, ids, materials and chordae stay; the state is carried over;
 * the history starts anew, as with mvs_load_file. MVS_E_ARGUMENT beyond 2^24 triangles. */
MVS_API mvs_result mvs_refine_valve(mvs_sim *sim);

/* How far to coarsen: one of the two. */
typedef struct mvs_coarsen_options {
  uint32_t struct_size;
  uint32_t vertices; /* of the leaflets, exactly; 0: by edge */
  double edge;       /* m, about the mean length of edges; 0: by vertices */
} mvs_coarsen_options;

/* What coarsening did to the valve. */
typedef struct mvs_coarsening {
  uint32_t struct_size;
  uint32_t vertices_before; /* of the leaflets */
  uint32_t vertices;
  uint32_t chords_moved;  /* chordae that end at another vertex, those below included */
  uint32_t chords_merged; /* chordae that became part of another one between the same nodes */
  uint32_t reserved;
  double chord_move;    /* m, the farthest that an end of a chord went */
  double surface_max;   /* m, largest distance of a vertex taken out from the coarse surface */
  double surface_rms;   /* m, root mean square of that over all vertices of the fine level */
  double worst_quality; /* of a triangle: 1 equilateral, 0 flat */
} mvs_coarsening;

/* Replaces the valve by a coarser level: vertices are taken out, those that stay stay where they
 * are. Annulus, free edge, borders of leaflets and scallops lose vertices along themselves only;
 * chordae go from vertex to vertex with chordae. The state is that of the vertices that stay; the
 * history starts anew. MVS_E_ARGUMENT says how few vertices this valve can have if more are to go,
 * and if it has fewer than asked for. `made` is nullable. */
MVS_API mvs_result mvs_coarsen_valve(mvs_sim *sim, const mvs_coarsen_options *options,
                                     mvs_coarsening *made);

/* Gives the simulator's valve the state of a snapshot of a coarser or finer level of it: positions,
 * velocities, time, load. To a coarser level it is the state of the common nodes. To a finer one it
 * goes by the triangles of the coarse level: a rest shape gives the rest shape and a rigid motion
 * the rigid motion, to rounding; what the heart holds is held where it is to be. The history starts
 * anew. MVS_E_ARGUMENT if they are not levels of one valve. */
MVS_API mvs_result mvs_transfer_state(mvs_sim *sim, const mvs_snapshot *from);

#ifdef __cplusplus
}
#endif
#endif
