/* Builds the coloured triangles of the valve, the instrument, and the force on the hand. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "phantom.h"

#define PI 3.14159265358979323846

typedef float tint[3];

static const tint anterior = {0.95f, 0.72f, 0.62f}, posterior = {0.82f, 0.50f, 0.46f};
static const tint annulus = {0.55f, 0.20f, 0.20f}, head = {0.60f, 0.25f, 0.25f};
static const tint cord = {0.80f, 0.76f, 0.62f}, chosen = {0.00f, 0.65f, 0.95f};
static const tint steel = {0.62f, 0.66f, 0.72f}, glove = {0.25f, 0.40f, 0.90f};
static const tint arrow = {0.95f, 0.45f, 0.05f}, hole = {0.75f, 0.05f, 0.10f};

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

/* to = a + t b */
static void along(const double a[3], double t, const double b[3], double to[3]) {
  int k;
  for (k = 0; k < 3; ++k) to[k] = a[k] + t * b[k];
}

static double unit(double v[3]) {
  const double length = sqrt(dot(v, v));
  int k;
  for (k = 0; length > 0 && k < 3; ++k) v[k] /= length;
  return length;
}

eye eye_of_surgeon(const mvs_snapshot *valve, double turn, double tilt, double distance) {
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
  return e;
}

void eye_matrix(const eye *from, double aspect, float m[16]) {
  const double zoom = 1 / tan(15 * PI / 180); /* field of view: 30 degrees */
  const double near = 0.2 * from->distance, far = 3 * from->distance;
  const double *const rows[3] = {from->right, from->up, from->back};
  double place[3];
  int k;
  along(from->middle, from->distance, from->back, place);
  for (k = 0; k < 4; ++k) {
    double seen[3];
    int r;
    for (r = 0; r < 3; ++r) seen[r] = k < 3 ? rows[r][k] : -dot(rows[r], place);
    m[4 * k] = (float)(zoom / aspect * seen[0]);
    m[4 * k + 1] = (float)(zoom * seen[1]);
    m[4 * k + 2] = (float)((far + near) / (near - far) * seen[2] +
                           (k < 3 ? 0 : 2 * far * near / (near - far)));
    m[4 * k + 3] = (float)-seen[2];
  }
}

static void add_corner(scene *out, const double at[3], const tint colour, double light) {
  int k;
  if (out->count == out->room) {
    out->room = out->room ? 2 * out->room : 4096;
    out->corners = realloc(out->corners, out->room * sizeof(corner));
    if (!out->corners) exit(1);
  }
  for (k = 0; k < 3; ++k) {
    out->corners[out->count].at[k] = (float)at[k];
    out->corners[out->count].colour[k] = (float)fmin(1, colour[k] * light);
  }
  ++out->count;
}

/* Light from a lamp beside the eye, on both sides of the tissue. */
static double lit(const eye *from, const double normal[3]) {
  double lamp[3];
  along(from->back, 0.4, from->up, lamp);
  along(lamp, -0.3, from->right, lamp);
  return 0.35 + 0.70 * fabs(dot(lamp, normal)) / sqrt(dot(lamp, lamp));
}

static mvs_view view(const mvs_snapshot *valve, uint32_t which) {
  mvs_view v;
  must(mvs_snapshot_get_array(valve, which, &v));
  return v;
}

/* Five colours of viridis (van der Walt and Smith 2015), from 0 to 1. */
static void colour_of(double share, tint out) {
  static const tint map[5] = {{0.27f, 0.00f, 0.33f},
                              {0.23f, 0.32f, 0.55f},
                              {0.13f, 0.57f, 0.55f},
                              {0.37f, 0.79f, 0.38f},
                              {0.99f, 0.91f, 0.14f}};
  const double x = 4 * fmax(0, fmin(1, share));
  const int low = x < 3 ? (int)x : 3;
  int k;
  for (k = 0; k < 3; ++k) {
    out[k] = (float)(map[low][k] + (x - low) * (map[low + 1][k] - map[low][k]));
  }
}

/* Adds a tapered tube with the normals of a cylinder. */
static void add_tube(scene *out, const eye *from, const double a[3], const double b[3],
                     const double radius[2], const tint colour) {
  enum { SIDES = 8 };
  double axis[3], u[3], v[3], normal[SIDES + 1][3], light[SIDES + 1];
  int k;
  along(b, -1, a, axis);
  if (unit(axis) == 0) return;
  cross(axis, fabs(dot(axis, from->back)) < 0.9 ? from->back : from->up, u);
  unit(u);
  cross(axis, u, v);
  for (k = 0; k <= SIDES; ++k) {
    memset(normal[k], 0, sizeof normal[k]);
    along(normal[k], cos(2 * PI * k / SIDES), u, normal[k]);
    along(normal[k], sin(2 * PI * k / SIDES), v, normal[k]);
    light[k] = lit(from, normal[k]);
  }
  for (k = 0; k < 6 * SIDES; ++k) {
    static const int side[6] = {0, 1, 1, 0, 1, 0}, end[6] = {0, 0, 1, 0, 1, 1};
    const int s = k / 6 + side[k % 6], e = end[k % 6];
    double at[3];
    along(e ? b : a, radius[e], normal[s], at);
    add_corner(out, at, colour, light[s]);
  }
}

static void add_line(scene *out, const eye *from, const double a[3], const double b[3],
                     double radius, const tint colour) {
  const double radii[2] = {radius, radius};
  add_tube(out, from, a, b, radii, colour);
}

/* Adds a sphere of rings about the axis towards the eye. */
static void add_ball(scene *out, const eye *from, const double middle[3], double radius,
                     const tint colour) {
  enum { RINGS = 8, SIDES = 16 };
  int k;
  for (k = 0; k < 6 * RINGS * SIDES; ++k) {
    static const int side[6] = {0, 1, 1, 0, 1, 0}, end[6] = {0, 0, 1, 0, 1, 1};
    const int ring = k / 6 / SIDES + end[k % 6], part = k / 6 % SIDES + side[k % 6];
    const double theta = PI * ring / RINGS, phi = 2 * PI * part / SIDES;
    double normal[3] = {0, 0, 0}, at[3];
    along(normal, cos(theta), from->back, normal);
    along(normal, sin(theta) * cos(phi), from->right, normal);
    along(normal, sin(theta) * sin(phi), from->up, normal);
    along(middle, radius, normal, at);
    add_corner(out, at, colour, lit(from, normal));
  }
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
    add_corner(out, x + 3 * node, colour, shade);
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

static void show_orifice(scene *out, const mvs_snapshot *measured) {
  const mvs_view faces = view(measured, MVS_ARRAY_ORIFICE_TRIANGLES);
  const double *x = view(measured, MVS_ARRAY_ORIFICE_VERTICES).data;
  const uint32_t *face = faces.data;
  uint64_t i;
  for (i = 0; i < 3 * faces.count; ++i) add_corner(out, x + 3 * face[i], hole, 1);
}

/* The instrument at its position in the tissue, the hand, and the force between them. */
static void show_instrument(scene *out, const eye *from, const sight *what) {
  const double tip[2] = {1.0e-3, 0}, strength = sqrt(dot(what->force, what->force));
  double beside[3], shaft[3], end[3];
  if (what->marked) add_ball(out, from, what->marked, 0.5e-3, chosen);
  if (what->tool.kind == MVS_TOOL_KIND_ROD) {
    along(what->tool.proxy, what->tool.length, what->tool.proxy_axis, end);
    add_line(out, from, what->tool.proxy, end, what->tool.radius, steel);
  }
  if (what->tool.kind) {
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

/* The strain scale, in front of everything, with a mark every 10 %. */
static void show_scale(scene *out, const eye *from) {
  const int parts = 50, marked = (int)(parts * 0.1 / STRAIN_FULL);
  const double size = 0.5 * from->distance;
  int i, k;
  for (i = 0; i < 6 * parts; ++i) {
    static const int side[6] = {0, 1, 1, 0, 1, 0}, end[6] = {0, 0, 1, 0, 1, 1};
    static const tint dark = {0.2f, 0.2f, 0.2f};
    const int part = i / 6;
    double at[3];
    tint colour;
    k = i % 6;
    colour_of((part + 0.5) / parts, colour);
    along(from->middle, size, from->back, at);
    along(at, size * (-0.345 + 0.02 * side[k]), from->right, at);
    along(at, size * (-0.2 + 0.4 * (part + end[k]) / parts), from->up, at);
    add_corner(out, at, part > 0 && part % marked == 0 ? dark : colour, 1);
  }
}

void scene_build(scene *out, const mvs_snapshot *valve, const eye *from, const sight *what) {
  out->count = 0;
  show_leaflets(out, valve, from, what->strain);
  show_chordae(out, valve, from, what);
  show_annulus_and_heads(out, valve, from);
  if (what->orifice) show_orifice(out, what->orifice);
  show_instrument(out, from, what);
  if (what->strain) show_scale(out, from);
}
