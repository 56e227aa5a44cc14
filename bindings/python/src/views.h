// The arrays of a snapshot; each is a read-only property of mvs.Snapshot.
#pragma once

#include <mvs/snapshot.h>

namespace mvs_python {

struct View {
  const char *name;
  uint32_t which;
  const char *doc;  // shape, type, unit, meaning
};

inline constexpr View views[] = {
    {"node_position", MVS_ARRAY_NODE_POSITION, "(n, 3) float64, m: present positions."},
    {"node_rest", MVS_ARRAY_NODE_REST, "(n, 3) float64, m: the open, unloaded valve."},
    {"node_loaded", MVS_ARRAY_NODE_LOADED,
     "(n, 3) float64, m: positions of prescribed nodes (annulus, heads) under load."},
    {"node_velocity", MVS_ARRAY_NODE_VELOCITY, "(n, 3) float64, m/s."},
    {"node_kind", MVS_ARRAY_NODE_KIND, "(n,) uint8: mvs.NodeKind."},
    {"node_force", MVS_ARRAY_NODE_FORCE,
     "(n, 3) float64, N: out-of-balance force; where prescribed the force of the valve "
     "on what holds it, the negative of a reaction force of FEBio or Abaqus."},
    {"node_contact_force", MVS_ARRAY_NODE_CONTACT_FORCE, "(n, 3) float64, N: force of contact."},
    {"node_coaptation", MVS_ARRAY_NODE_COAPTATION,
     "(n,) float64, m: distance to the facing leaflet; infinity without one."},
    {"node_open", MVS_ARRAY_NODE_OPEN,
     "(n, 3) float64, m: positions of prescribed nodes (annulus, heads) without load."},
    {"node_origin", MVS_ARRAY_NODE_ORIGIN,
     "(n,) uint32: the node's index before any operation; 2**32 - 1 for a new node."},
    {"triangle_nodes", MVS_ARRAY_TRIANGLE_NODES, "(m, 3) uint32: normals point into the atrium."},
    {"triangle_leaflet", MVS_ARRAY_TRIANGLE_LEAFLET, "(m,) uint32: index of the leaflet."},
    {"triangle_scallop", MVS_ARRAY_TRIANGLE_SCALLOP, "(m,) uint32: index of the scallop."},
    {"triangle_thickness", MVS_ARRAY_TRIANGLE_THICKNESS, "(m,) float64, m."},
    {"triangle_fibre", MVS_ARRAY_TRIANGLE_FIBRE, "(m, 3) float64: unit fibre direction at rest."},
    {"triangle_stretch", MVS_ARRAY_TRIANGLE_STRETCH,
     "(m, 2) float64: principal stretches, larger first."},
    {"triangle_stress", MVS_ARRAY_TRIANGLE_STRESS,
     "(m, 2) float64, Pa: principal Cauchy stresses, larger first."},
    {"triangle_strain_fibre", MVS_ARRAY_TRIANGLE_STRAIN_FIBRE,
     "(m, 3) float64: Green-Lagrange strain along the fibre (circumferential), across it (radial), "
     "in shear."},
    {"triangle_stress_fibre", MVS_ARRAY_TRIANGLE_STRESS_FIBRE,
     "(m, 3) float64, Pa: Cauchy stress, turned back by the rotation of the triangle, in the same "
     "order."},
    {"triangle_direction", MVS_ARRAY_TRIANGLE_DIRECTION,
     "(m, 3) float64: unit direction of the largest stretch."},
    {"node_strain_fibre", MVS_ARRAY_NODE_STRAIN_FIBRE,
     "(n, 3) float64: triangle_strain_fibre, mean of the triangles at a node by rest area."},
    {"node_stress_fibre", MVS_ARRAY_NODE_STRESS_FIBRE,
     "(n, 3) float64, Pa: triangle_stress_fibre, mean of the triangles at a node by rest area."},
    {"node_mode", MVS_ARRAY_NODE_MODE,
     "(n, 3) float64: mode of `stability`, the real part of the eigenvector; the longest "
     "displacement is 1."},
    {"triangle_coapted", MVS_ARRAY_TRIANGLE_COAPTED,
     "(m,) float64: share of the triangle that faces another leaflet."},
    {"leaflet_law", MVS_ARRAY_LEAFLET_LAW, "(l,) uint32: mvs.LeafletLaw."},
    {"leaflet_constants", MVS_ARRAY_LEAFLET_CONSTANTS,
     "(l, 9) float64: thickness in m, then the constants of the law."},
    {"annulus_nodes", MVS_ARRAY_ANNULUS_NODES, "(k,) uint32: in order around the annulus."},
    {"annulus_force", MVS_ARRAY_ANNULUS_FORCE,
     "(k, 3) float64, N: pull of tissue and pressure on each of annulus_nodes, which the sutures "
     "of a ring "
     "bear."},
    {"free_edge_nodes", MVS_ARRAY_FREE_EDGE_NODES, "(f,) uint32: in order along the free edge."},
    {"chord_nodes", MVS_ARRAY_CHORD_NODES, "(c, 2) uint32: papillary side first."},
    {"chord_rest_length", MVS_ARRAY_CHORD_REST_LENGTH, "(c,) float64, m."},
    {"chord_kind", MVS_ARRAY_CHORD_KIND, "(c,) uint32: mvs.ChordKind."},
    {"chord_strain", MVS_ARRAY_CHORD_STRAIN, "(c,) float64: (L - L0) / L0, negative when slack."},
    {"chord_tension", MVS_ARRAY_CHORD_TENSION, "(c,) float64, N."},
    {"chord_id", MVS_ARRAY_CHORD_ID, "(c,) uint64: stable ids."},
    {"chord_young", MVS_ARRAY_CHORD_YOUNG, "(c,) float64, Pa."},
    {"chord_area", MVS_ARRAY_CHORD_AREA, "(c,) float64, m2: cross-section."},
    {"chord_flags", MVS_ARRAY_CHORD_FLAGS,
     "(c,) uint8: 1 strained, 2 loaded beyond the limit of its kind."},
    {"chord_law", MVS_ARRAY_CHORD_LAW, "(c,) uint32: mvs.ChordLaw."},
    {"chord_constants", MVS_ARRAY_CHORD_CONSTANTS, "(c, 6) float64: constants of the law."},
    {"curve_points", MVS_ARRAY_CURVE_POINTS,
     "(p, 2) float64: strain, nominal stress in Pa; the points of all curves, one after another."},
    {"curve_start", MVS_ARRAY_CURVE_START,
     "(k + 1,) uint32: first row of each curve, then the number of rows."},
    {"head_nodes", MVS_ARRAY_HEAD_NODES, "(h,) uint32: nodes of the papillary heads."},
    {"head_force", MVS_ARRAY_HEAD_FORCE, "(h, 3) float64, N: pull of the chordae on each head."},
    {"ring_points", MVS_ARRAY_RING_POINTS,
     "(p, 3) float64, m: the points of all rings, one after another."},
    {"ring_start", MVS_ARRAY_RING_START,
     "(r + 1,) uint32: first row of each ring, then the number of rows."},
    {"ring_kind", MVS_ARRAY_RING_KIND, "(r,) uint32: mvs.RingKind."},
    {"ring_id", MVS_ARRAY_RING_ID, "(r,) uint64: stable ids."},
    {"orifice_vertices", MVS_ARRAY_ORIFICE_VERTICES,
     "(o, 3) float64, m: the smallest opening; empty when sealed."},
    {"orifice_triangles", MVS_ARRAY_ORIFICE_TRIANGLES,
     "(q, 3) uint32 into orifice_vertices: the opening as triangles."},
    {"orifice_part", MVS_ARRAY_ORIFICE_PART,
     "(q,) uint32: row of the triangle's part in orifice_parts()."},
    {"valve_constants", MVS_ARRAY_VALVE_CONSTANTS,
     "(4,) float64: density, kg/m3; contact thickness, m; contact stiffness, Pa; bending scale."},
    {"state_time", MVS_ARRAY_STATE_TIME,
     "(1,) float64, s: simulated time since the valve was set."},
};

}  // namespace mvs_python
