/* Vectors, and the triangles of tubes, spheres, rectangles and lines. */
#include "draw.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void cross(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

void along(const double a[3], double t, const double b[3], double to[3]) {
  int k;
  for (k = 0; k < 3; ++k) to[k] = a[k] + t * b[k];
}

double unit(double v[3]) {
  const double length = sqrt(dot(v, v));
  int k;
  for (k = 0; length > 0 && k < 3; ++k) v[k] /= length;
  return length;
}

void add_corner(scene *out, const double at[3], const tint colour, double light, double alpha) {
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
  out->corners[out->count].colour[3] = (float)alpha;
  ++out->count;
}

double lit(const eye *from, const double normal[3]) {
  double lamp[3];
  along(from->back, 0.4, from->up, lamp);
  along(lamp, -0.3, from->right, lamp);
  return 0.35 + 0.70 * fabs(dot(lamp, normal)) / sqrt(dot(lamp, lamp));
}

/* Five colours of viridis (van der Walt and Smith 2015), from 0 to 1. */
void colour_of(double share, tint out) {
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

void add_tube(scene *out, const eye *from, const double a[3], const double b[3],
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
    add_corner(out, at, colour, light[s], 1);
  }
}

void add_line(scene *out, const eye *from, const double a[3], const double b[3], double radius,
              const tint colour) {
  const double radii[2] = {radius, radius};
  add_tube(out, from, a, b, radii, colour);
}

/* Adds a sphere of rings about the axis towards the eye. */
void add_ball(scene *out, const eye *from, const double middle[3], double radius,
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
    add_corner(out, at, colour, lit(from, normal), 1);
  }
}

/* The plane of flat shapes lies halfway between the eye and the middle of the valve. */
void screen_point(const eye *from, double x, double y, double at[3]) {
  const double half = 0.5 * from->distance;
  along(from->middle, half, from->back, at);
  along(at, half * EYE_SLOPE * x, from->right, at);
  along(at, half * EYE_SLOPE * y, from->up, at);
}

void screen_place(const eye *from, const double at[3], double *x, double *y) {
  double seen[3], depth;
  along(at, -1, from->middle, seen);
  depth = from->distance - dot(seen, from->back);
  *x = dot(seen, from->right) / (EYE_SLOPE * depth);
  *y = dot(seen, from->up) / (EYE_SLOPE * depth);
}

/* Two triangles between four points of the screen. */
static void add_quad(scene *out, const eye *from, double points[4][2], const tint colour,
                     double alpha) {
  static const int order[6] = {0, 1, 2, 0, 2, 3};
  double at[3];
  int k;
  for (k = 0; k < 6; ++k) {
    screen_point(from, points[order[k]][0], points[order[k]][1], at);
    add_corner(out, at, colour, 1, alpha);
  }
}

void add_plate(scene *out, const eye *from, const double low[2], const double high[2],
               const tint colour, double alpha) {
  double points[4][2] = {
      {low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}};
  add_quad(out, from, points, colour, alpha);
}

void add_stroke(scene *out, const eye *from, const double a[2], const double b[2], double width,
                const tint colour) {
  const double x = b[0] - a[0], y = b[1] - a[1], length = hypot(x, y);
  /* half of the width along the stroke and across it: the ends are longer by it, so that strokes
   * meet without a notch */
  const double u = 0.5 * width * (length > 0 ? x / length : 1);
  const double v = 0.5 * width * (length > 0 ? y / length : 0);
  double points[4][2] = {{a[0] - u + v, a[1] - v - u},
                         {b[0] + u + v, b[1] + v - u},
                         {b[0] + u - v, b[1] + v + u},
                         {a[0] - u - v, a[1] - v + u}};
  add_quad(out, from, points, colour, 1);
}
