/* Convex instruments: their bodies in the frame of the hand, whose z axis is the stylus; their
 * picture. */
#include <math.h>

#include "draw.h"

/* A nerve hook: shaft, bar, and a tip that points back. */
static const mvs_body_desc hook[3] = {
    {.kind = MVS_BODY_KIND_CAPSULE, .end = {0, 0, 30e-3}, .radius = 0.5e-3},
    {.kind = MVS_BODY_KIND_CAPSULE, .end = {3e-3, 0, 0}, .radius = 0.5e-3},
    {.kind = MVS_BODY_KIND_CAPSULE,
     .position = {3e-3, 0, 0},
     .end = {3e-3, 0, 2e-3},
     .radius = 0.4e-3}};
/* A spatula: a rounded plate on a handle. */
static const mvs_body_desc spatula[2] = {
    {.kind = MVS_BODY_KIND_BOX, .size = {5e-3, 0.6e-3, 9e-3}, .radius = 0.3e-3},
    {.kind = MVS_BODY_KIND_CAPSULE,
     .position = {0, 0, 4e-3},
     .end = {0, 0, 34e-3},
     .radius = 1e-3}};
/* A sizer: a disc with a blunt nose. */
static const mvs_body_desc sizer[3] = {
    {.kind = MVS_BODY_KIND_CYLINDER, .end = {0, 0, 2e-3}, .size = {6e-3, 0, 0}, .radius = 0.5e-3},
    {.kind = MVS_BODY_KIND_CONE, .end = {0, 0, -4e-3}, .size = {5.5e-3, 0, 0}, .radius = 0.5e-3},
    {.kind = MVS_BODY_KIND_CAPSULE,
     .position = {0, 0, 2e-3},
     .end = {0, 0, 32e-3},
     .radius = 1.5e-3}};

static const struct {
  const char *name;
  const mvs_body_desc *bodies;
  uint32_t count;
} instruments[] = {{"hook", hook, 3}, {"spatula", spatula, 2}, {"sizer", sizer, 3}};

static unsigned present;

const char *instrument_give(mvs_device_hand *to) {
  to->bodies = instruments[present].bodies;
  to->body_count = instruments[present].count;
  to->body_stride = sizeof *to->bodies;
  return instruments[present].name;
}

const char *instrument_next(void) {
  present = (present + 1) % (sizeof instruments / sizeof instruments[0]);
  return instruments[present].name;
}

/* v turned by a quaternion w x y z. */
static void turned(const double q[4], const double v[3], double to[3]) {
  double once[3], twice[3];
  cross(q + 1, v, once);
  along(once, q[0], v, once);
  cross(q + 1, once, twice);
  along(v, 2, twice, to);
}

/* A body of a convex tool: its faces and edges, as thick as it is rounded. */
static void show_body(scene *out, const eye *from, const mvs_tool_state *tool,
                      const mvs_tool_body *body, const tint colour) {
  const double *v = body->vertices.data;
  const uint32_t *t = body->triangles.data;
  const double thick = fmax(body->radius, 0.1e-3);
  uint64_t i;
  int k;
  for (i = 0; i + 1 < body->vertices.count && body->triangles.count == 0; ++i) {
    double a[3], b[3];
    turned(tool->proxy_orientation, v + 3 * i, a);
    turned(tool->proxy_orientation, v + 3 * i + 3, b);
    along(a, 1, tool->proxy, a);
    along(b, 1, tool->proxy, b);
    add_line(out, from, a, b, thick, colour);
    add_ball(out, from, a, thick, colour);
    add_ball(out, from, b, thick, colour);
  }
  for (i = 0; i < body->triangles.count; ++i) {
    double p[3][3], ab[3], ac[3], normal[3];
    for (k = 0; k < 3; ++k) {
      turned(tool->proxy_orientation, v + 3 * t[3 * i + k], p[k]);
      along(p[k], 1, tool->proxy, p[k]);
    }
    along(p[1], -1, p[0], ab);
    along(p[2], -1, p[0], ac);
    cross(ab, ac, normal);
    unit(normal);
    for (k = 0; k < 3; ++k) {
      double at[3];
      along(p[k], body->radius, normal, at);
      add_corner(out, at, colour, lit(from, normal), 1);
    }
  }
}

void show_bodies(scene *out, const mvs_snapshot *valve, const eye *from, const mvs_tool_state *tool,
                 const tint colour) {
  mvs_tool_state other = {.struct_size = sizeof other};
  mvs_tool_body body = {.struct_size = sizeof body};
  uint32_t count, index, k;
  must(mvs_snapshot_get_tool_count(valve, &count));
  for (index = 0; index < count; ++index) {
    must(mvs_snapshot_get_tool(valve, index, &other));
    if (other.id != tool->id) continue;
    for (k = 0; k < other.body_count; ++k) {
      must(mvs_snapshot_get_tool_body(valve, index, k, &body));
      show_body(out, from, tool, &body, colour);
    }
  }
}
