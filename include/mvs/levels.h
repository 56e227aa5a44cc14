/* Mesh levels of one valve: refinement, coarsening and transfer of states. Experimental
 * (experimental.h).
 *
 * The vertices of a coarser level are vertices of the finer one with the same rest positions bit
 * for bit, so that results of two levels can be compared node by node. MVS_ARRAY_NODE_ORIGIN gives
 * the correspondence: the node's index in the valve that was set, generated or loaded, UINT32_MAX
 * for a node that refinement added.
 *
 * The rest shape of a refined valve is the same surface of flat triangles: closures of two levels
 * differ by discretisation, not by shape. */
#ifndef MVS_LEVELS_H
#define MVS_LEVELS_H

#include "base.h"
#include "sim.h"
#include "snapshot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Replaces the valve by the next finer level: each triangle is divided into four. Old nodes keep
 * their index, new nodes follow. Parts, names, ids, materials and chordae do not change; the state
 * is interpolated; the history starts anew, as with mvs_load_file. MVS_E_ARGUMENT beyond 2^24
 * triangles. */
MVS_API mvs_result mvs_refine_valve(mvs_sim *sim);

/* Target of coarsening: exactly one field is given. */
typedef struct mvs_coarsen_options {
  uint32_t struct_size;
  uint32_t vertices; /* exact number of leaflet vertices */
  double edge;       /* m, approximate mean length of edges */
} mvs_coarsen_options;

/* Result of coarsening. */
typedef struct mvs_coarsening {
  uint32_t struct_size;
  uint32_t vertices_before; /* of the leaflets */
  uint32_t vertices;
  uint32_t chords_moved;  /* chordae that end at another vertex, merged ones included */
  uint32_t chords_merged; /* chordae merged with another one between the same nodes */
  uint32_t reserved;
  double chord_move;    /* m, largest displacement of the end of a chord */
  double surface_max;   /* m, largest distance of a removed vertex from the coarse surface */
  double surface_rms;   /* m, root mean square of that over all vertices of the fine level */
  double worst_quality; /* of a triangle: 1 equilateral, 0 flat */
} mvs_coarsening;

/* Replaces the valve by a coarser level: vertices are removed, the remaining ones do not move.
 * Annulus, free edge, borders of leaflets and scallops lose vertices only along themselves; chordae
 * of a removed vertex move to a vertex that has chordae. The state is that of the remaining
 * vertices; the history starts anew. MVS_E_ARGUMENT states the smallest possible number of vertices
 * if the target is below it, and if the valve has fewer vertices than asked for. `made` is
 * nullable. */
MVS_API mvs_result mvs_coarsen_valve(mvs_sim *sim, const mvs_coarsen_options *options,
                                     mvs_coarsening *made);

/* Transfers positions, velocities, time and load from a snapshot of a coarser or finer level of the
 * same valve. A coarser level takes the state of the common nodes. A finer level interpolates on
 * the triangles of the coarse one, which reproduces the rest shape and rigid motions to rounding;
 * prescribed nodes take their prescribed positions. The history starts anew. MVS_E_ARGUMENT if the
 * two are not levels of one valve. */
MVS_API mvs_result mvs_transfer_state(mvs_sim *sim, const mvs_snapshot *from);

#ifdef __cplusplus
}
#endif
#endif
