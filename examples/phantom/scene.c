/* Builds the coloured triangles of the valve, the instrument, and the force on the hand. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw.h"

static const tint anterior = {0.95f, 0.72f, 0.62f}, posterior = {0.82f, 0.50f, 0.46f};
static const tint annulus = {0.55f, 0.20f, 0.20f}, head = {0.60f, 0.25f, 0.25f};
static const tint cord = {0.80f, 0.76f, 0.62f}, chosen = {0.00f, 0.65f, 0.95f};
static const tint steel = {0.62f, 0.66f, 0.72f}, glove = {0.25f, 0.40f, 0.90f};
static const tint arrow = {0.95f, 0.45f, 0.05f};

eye eye_of_surgeon(const mvs_snapshot *valve, double turn, double tilt, double distance,
                   double aspect) {
  double f[12], towards_user[3] = {0, 0, 0};
  eye e;
  must(mvs_snapshot_get_frame(valve, f)); /* rows: origin, AP, CC, axis into the atrium */
  along(f, -6e-3, f + 9, e.middle);       /* lower, so that the chordae are visible */
  along(towards_user, -cos(turn), f + 3, towards_user);
  along(towards_user, sin(turn), f + 6, towards_user);
  memset(e.back, 0, sizeof e.back);
  along(e.back, cos(tilt), f + 9, e.back);
  along(e.back, sin(tilt), towards_user, e.back);
  cross(f + 9, towards_user, e.right);
  cross(e.back, e.right, e.up);
  e.distance = distance;
  e.aspect = aspect;
  return e;
}

void eye_matrix(const eye *from, float m[16]) {
  const double zoom = 1 / EYE_SLOPE;
  const double near = 0.2 * from->distance, far = 3 * from->distance;
  const double *const rows[3] = {from->right, from->up, from->back};
  double place[3];
  int k;
  along(from->middle, from->distance, from->back, place);
  for (k = 0; k < 4; ++k) {
    double seen[3];
    int r;
    for (r = 0; r < 3; ++r) seen[r] = k < 3 ? rows[r][k] : -dot(rows[r], place);
    m[4 * k] = (float)(zoom / from->aspect * seen[0]);
    m[4 * k + 1] = (float)(zoom * seen[1]);
    m[4 * k + 2] = (float)((far + near) / (near - far) * seen[2] +
                           (k < 3 ? 0 : 2 * far * near / (near - far)));
    m[4 * k + 3] = (float)-seen[2];
  }
}

mvs_view view(const mvs_snapshot *valve, uint32_t which) {
  mvs_view v;
  must(mvs_snapshot_get_array(valve, which, &v));
  return v;
}

mvs_device_view map_of_surgeon(const mvs_snapshot *valve, double scale) {
  const eye e = eye_of_surgeon(valve, 0, 0, 1, 1);
  const double x = e.right[0], y = e.back[1], z = -e.up[2];
  mvs_device_view map = {0};
  double frame[12];
  must(mvs_snapshot_get_frame(valve, frame));
  map.struct_size = sizeof map;
  map.scale = scale;
  memcpy(map.origin, frame, sizeof map.origin);
  map.rotation[0] = sqrt(fmax(0, 1 + x + y + z));
  map.rotation[1] = copysign(sqrt(fmax(0, 1 + x - y - z)), e.back[2] + e.up[1]);
  map.rotation[2] = copysign(sqrt(fmax(0, 1 - x + y - z)), -e.up[0] - e.right[2]);
  map.rotation[3] = copysign(sqrt(fmax(0, 1 - x - y + z)), e.right[1] - e.back[0]);
  return map;
}

static void show_leaflets(scene *out, const mvs_snapshot *valve, const eye *from, int strain) {
  const mvs_view nodes = view(valve, MVS_ARRAY_NODE_POSITION),
                 faces = view(valve, MVS_ARRAY_TRIANGLE_NODES);
  const double *x = nodes.data, *stretch = view(valve, MVS_ARRAY_TRIANGLE_STRETCH).data;
  const uint32_t *t = faces.data, *leaflet = view(valve, MVS_ARRAY_TRIANGLE_LEAFLET).data;
  const uint32_t *scallop = view(valve, MVS_ARRAY_TRIANGLE_SCALLOP).data;
  /* per node: sums of the normals and strains of its triangles, and their number */
  double(*sum)[5] = calloc(nodes.count, sizeof *sum);
  uint64_t i;
  int k;
  if (!sum) exit(1);
  for (i = 0; i < faces.count; ++i) {
    double a[3], b[3], normal[3];
    along(x + 3 * t[3 * i + 1], -1, x + 3 * t[3 * i], a);
    along(x + 3 * t[3 * i + 2], -1, x + 3 * t[3 * i], b);
    cross(a, b, normal);
    for (k = 0; k < 3; ++k) {
      along(sum[t[3 * i + k]], 1, normal, sum[t[3 * i + k]]);
      sum[t[3 * i + k]][3] += stretch[2 * i] - 1;
      sum[t[3 * i + k]][4] += 1;
    }
  }
  for (i = 0; i < nodes.count; ++i) unit(sum[i]);
  for (i = 0; i < 3 * faces.count; ++i) {
    const uint32_t node = t[i];
    tint colour;
    double shade = lit(from, sum[node]);
    memcpy(colour, leaflet[i / 3] == 0 ? anterior : posterior, sizeof colour);
    if (strain) colour_of(sum[node][3] / sum[node][4] / STRAIN_FULL, colour);
    if (!strain && scallop[i / 3] % 2 == 0) shade *= 0.85; /* so that neighbours differ */
    add_corner(out, x + 3 * node, colour, shade, 1);
  }
  free(sum);
}

/* Highlights the selected chord; slack chordae have no strain colour. */
static void show_chordae(scene *out, const mvs_snapshot *valve, const eye *from,
                         const sight *what) {
  const double *x = view(valve, MVS_ARRAY_NODE_POSITION).data;
  const mvs_view ends = view(valve, MVS_ARRAY_CHORD_NODES);
  const uint32_t *nodes = ends.data;
  const mvs_id *id = view(valve, MVS_ARRAY_CHORD_ID).data;
  const double *strain = view(valve, MVS_ARRAY_CHORD_STRAIN).data;
  uint64_t i;
  for (i = 0; i < ends.count; ++i) {
    const int stands_out = id[i] == what->chord;
    tint colour;
    memcpy(colour, cord, sizeof colour);
    if (what->strain && strain[i] > 0) colour_of(strain[i] / CHORD_STRAIN_FULL, colour);
    add_line(out, from, x + 3 * nodes[2 * i], x + 3 * nodes[2 * i + 1],
             stands_out ? 0.6e-3 : 0.25e-3, stands_out ? chosen : colour);
  }
}

static void show_annulus_and_heads(scene *out, const mvs_snapshot *valve, const eye *from) {
  const double *x = view(valve, MVS_ARRAY_NODE_POSITION).data;
  const mvs_view loop = view(valve, MVS_ARRAY_ANNULUS_NODES),
                 heads = view(valve, MVS_ARRAY_HEAD_NODES);
  const uint32_t *a = loop.data, *h = heads.data;
  uint64_t i;
  for (i = 0; i < loop.count; ++i) {
    add_line(out, from, x + 3 * a[i], x + 3 * a[(i + 1) % loop.count], 0.7e-3, annulus);
  }
  for (i = 0; i < heads.count; ++i) add_ball(out, from, x + 3 * h[i], 1e-3, head);
}

/* The instrument at its position in the tissue, the hand, and the force between them. */
static void show_instrument(scene *out, const mvs_snapshot *valve, const eye *from,
                            const sight *what) {
  const double tip[2] = {1.0e-3, 0}, strength = sqrt(dot(what->force, what->force));
  double beside[3], shaft[3], end[3];
  if (what->marked) add_ball(out, from, what->marked, 0.5e-3, chosen);
  if (what->tool.kind == MVS_TOOL_KIND_ROD) {
    along(what->tool.proxy, what->tool.length, what->tool.proxy_axis, end);
    add_line(out, from, what->tool.proxy, end, what->tool.radius, steel);
  }
  if (what->tool.kind == MVS_TOOL_KIND_CONVEX) {
    show_bodies(out, valve, from, &what->tool, steel);
    add_line(out, from, what->tool.proxy, what->hand, 0.15e-3, steel);
  } else if (what->tool.kind) {
    add_ball(out, from, what->tool.proxy, fmax(what->tool.radius, 1.2e-3), steel);
    add_line(out, from, what->tool.proxy, what->hand, 0.15e-3, steel);
  }
  add_ball(out, from, what->hand, 0.9e-3, glove);
  if (strength < 0.01) return;
  along(what->hand, 2e-3, from->right,
        beside); /* beside the hand, so that neither hides the other */
  along(beside, 5e-3, what->force, shaft);
  along(shaft, 3e-3 / strength, what->force, end);
  add_line(out, from, beside, shaft, 0.4e-3, arrow);
  add_tube(out, from, shaft, end, tip, arrow);
}

void scene_build(scene *out, const mvs_snapshot *valve, const eye *from, const sight *what) {
  out->count = 0;
  show_leaflets(out, valve, from, what->strain);
  show_chordae(out, valve, from, what);
  show_annulus_and_heads(out, valve, from);
  show_instrument(out, valve, from, what);
  out->solid = out->count;
  show_orifice(out, from, &what->orifice);
  if (what->strain) show_scale(out, from);
}
