/* Cost of a repair: how far the valve opens in diastole, how near its coaptation lies to the
 * septum, and what chordae and annulus bear. Every valve closes in a ring that is small enough;
 * a search for a repair has to weigh these figures against the leak. */
#ifndef MVS_COST_H
#define MVS_COST_H

#include "base.h"
#include "snapshot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* 5 mmHg in Pa: the default pressure difference that opens the valve in diastole. */
#define MVS_DIASTOLE_PA 666.61

/* Accepted flows through an open valve, m3/s: it is about twice the cardiac output, 16 ml/s of a
 * newborn child and 250 of an adult. Numbers in l/min or l/s lie outside. */
#define MVS_FLOW_MIN 1e-5
#define MVS_FLOW_MAX 1e-2

/* Options of mvs_snapshot_measure_cost. */
typedef struct mvs_cost_options {
  uint32_t struct_size;
  mvs_backend backend; /* MVS_BACKEND_* */
  double pressure;     /* Pa, atrium minus ventricle in diastole, 20 or more [MVS_DIASTOLE_PA] */
  double residual;     /* N, at rest, as in mvs_settle_options [1e-5] */
  double flow;         /* m3/s through the open valve, MVS_FLOW_MIN to MVS_FLOW_MAX [not known: no
                          gradient] */
  double density;      /* kg/m3, of blood [1060] */
  double discharge;    /* discharge coefficient, 0.1 to 1 [0.85] */
  mvs_array septum;    /* F64 or F32, k x 3, m: points of the septum where it faces the
                          anterior leaflet in systole, in front of the coaptation, within 0.1 m of
                          it, and 1 mm or more apart [not known: no risk of SAM] */
  /* As in mvs_sim_desc, of the opening. Nullable. */
  int32_t (*progress)(void *user, double share, double residual);
  void *user;
} mvs_cost_options;

/* Risk of systolic anterior motion (SAM) of the anterior leaflet into the outflow tract. */
enum mvs_sam_risk_e {
  MVS_SAM_NOT_DETERMINED = 0, /* no septal points, or not closed at rest under load */
  MVS_SAM_LOW = 1,            /* neither of the two conditions below */
  MVS_SAM_RAISED = 2          /* length_ratio at most 1.3, or septal_distance at most 25 mm */
};
typedef uint32_t mvs_sam_risk;

/* Cost of a repair (fields: MVS_STRUCT_COST). Definitions and sources:
 * libmvs/measure/DEFINITIONS.md. A figure that is not known is NaN. */
typedef struct mvs_cost {
  uint32_t struct_size;
  uint32_t opened;             /* 1: the open valve came to rest; otherwise open_area is NaN */
  double open_area;            /* m2, smallest cross-section of the open valve */
  double gradient;             /* Pa, mean pressure drop of the flow through open_area */
  double anterior_height;      /* m, tissue from annulus to free edge, unloaded, central AP plane
                                  or, with a seam there, beside it */
  double posterior_height;     /* m, the same of the posterior leaflet */
  double anterior_length;      /* m, from annulus to coaptation, closed, in the same way */
  double posterior_length;     /* m, the same of the posterior leaflet */
  double length_ratio;         /* anterior_length / posterior_length */
  double septal_distance;      /* m, from coaptation in the central AP plane to the nearest point of
                                  the septum */
  double annulus_force_max;    /* N, largest pull on a node of the annulus */
  double annulus_force_sum;    /* N, sum of the magnitudes over the nodes of the annulus */
  mvs_sam_risk sam_risk;       /* MVS_SAM_* */
  uint32_t rings;              /* rings and bands, whose sutures bear the pull of the annulus */
  uint32_t chords_over_strain; /* as in mvs_measures */
  uint32_t chords_over_tension; /* as in mvs_measures */
} mvs_cost;

/* Measures the cost of the repair of a snapshot. The snapshot is of the closed valve; it is then
 * opened in a copy: boundary_fraction 0, a pressure difference that opens, Newton's method.
 *
 * *opened receives the open valve, the same bits as after mvs_restore, mvs_set_load and
 * mvs_settle; release it with mvs_snapshot_release. Tools stay as they are. If the open valve does
 * not come to rest, cost->opened is 0. MVS_E_CANCELLED if the callback cancelled. `options` and
 * `opened` are nullable. From any thread. */
MVS_API mvs_result mvs_snapshot_measure_cost(const mvs_snapshot *snapshot,
                                             const mvs_cost_options *options, mvs_cost *cost,
                                             const mvs_snapshot **opened);

#ifdef __cplusplus
}
#endif
#endif
