/* Leaflets in memory as mvs_build_valve takes them, and findings by name. */
#ifndef MVS_TESTS_API_SURFACE_H
#define MVS_TESTS_API_SURFACE_H

#include "check.h"

enum { most_points = 4000, most_triangles = 8000 };

/* The leaflets of a generated valve as a surface in memory. */
typedef struct surface {
  double points[most_points][3];
  uint32_t triangles[most_triangles][3];
  double tips[8][3];
  uint32_t point_count, triangle_count, tip_count;
} surface;

static inline mvs_view array_of(const mvs_snapshot *snapshot, mvs_array_kind which, uint64_t most) {
  mvs_view view = {0};
  MUST(mvs_snapshot_get_array(snapshot, which, &view));
  CHECK(view.count <= most);
  return view;
}

static inline void take_surface(surface *s) {
  mvs_sim *sim = NULL;
  const mvs_snapshot *snapshot = NULL;
  MUST(mvs_create(NULL, &sim));
  MUST(mvs_generate_valve(sim, NULL));
  MUST(mvs_get_snapshot(sim, &snapshot));
  const mvs_view nodes = array_of(snapshot, MVS_ARRAY_NODE_REST, most_points);
  const mvs_view triangles = array_of(snapshot, MVS_ARRAY_TRIANGLE_NODES, most_triangles);
  const mvs_view kinds = array_of(snapshot, MVS_ARRAY_NODE_KIND, most_points);
  memcpy(s->points, nodes.data, sizeof(double) * 3 * nodes.count);
  memcpy(s->triangles, triangles.data, sizeof(uint32_t) * 3 * triangles.count);
  s->point_count = (uint32_t)nodes.count;
  s->triangle_count = (uint32_t)triangles.count;
  s->tip_count = 0;
  for (uint32_t k = 0; k < nodes.count; ++k) {
    if (((const uint8_t *)kinds.data)[k] != MVS_NODE_KIND_HEAD || s->tip_count == 8) continue;
    memcpy(s->tips[s->tip_count++], s->points[k], sizeof s->tips[0]);
  }
  mvs_snapshot_release(snapshot);
  mvs_destroy(sim);
}

static inline mvs_array points_of(double (*points)[3], uint64_t count) {
  mvs_array array = {points, count, 3, MVS_TYPE_F64, 0};
  return array;
}

static inline mvs_surface_desc desc_of(surface *s) {
  mvs_surface_desc desc = {.struct_size = sizeof desc};
  desc.points = points_of(s->points, s->point_count);
  desc.triangles = (mvs_array){s->triangles, s->triangle_count, 3, MVS_TYPE_U32, 0};
  desc.papillary_tips = points_of(s->tips, s->tip_count);
  return desc;
}

/* The index of a finding with this name; UINT32_MAX: none. */
static inline uint32_t find(const mvs_findings *findings, const char *name, mvs_finding *finding) {
  uint32_t count = 0;
  MUST(mvs_findings_get_count(findings, &count));
  for (uint32_t k = 0; k < count; ++k) {
    finding->struct_size = sizeof *finding;
    MUST(mvs_findings_get(findings, k, finding));
    if (strcmp(finding->name, name) == 0) return k;
  }
  return UINT32_MAX;
}

#endif
