/* Draws the regurgitant orifice over the valve: filled, with its outline and its area in mm2.
 *
 * A leak may be graded only at rest under load (mvs_measures). A valve that is not under load has
 * no regurgitant orifice, and none is drawn. While the valve moves under load, the opening is drawn
 * fainter and without its area, which is not that of an equilibrium. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "draw.h"

static const tint blood = {0.85f, 0.05f, 0.10f}, paper = {1.00f, 1.00f, 1.00f};

/* m2; a smaller opening is sealed, as "0.0 mm2" in all messages. */
#define SEALED 0.05e-6

typedef struct edge {
  uint32_t low, high;
} edge;

static int compare(const void *a, const void *b) {
  const edge *const x = a, *const y = b;
  if (x->low != y->low) return x->low < y->low ? -1 : 1;
  return x->high < y->high ? -1 : x->high > y->high;
}

/* Sorts the edges of the triangles; returns their number. */
static size_t edges_of(const mvs_view *faces, edge *edges) {
  const uint32_t *t = faces->data;
  size_t i, count = 3 * (size_t)faces->count;
  for (i = 0; i < count; ++i) {
    const uint32_t a = t[i], b = t[i % 3 == 2 ? i - 2 : i + 1];
    edges[i].low = a < b ? a : b;
    edges[i].high = a < b ? b : a;
  }
  qsort(edges, count, sizeof *edges, compare);
  return count;
}

/* The outline: edges of one triangle only. `right` becomes the largest x of it on the screen. */
static void show_outline(scene *out, const eye *from, const mvs_view *faces, const double *x,
                         double width, double *right) {
  edge *const edges = malloc((3 * (size_t)faces->count + 1) * sizeof *edges);
  size_t count, i;
  if (!edges) exit(1);
  count = edges_of(faces, edges);
  for (i = 0; i < count; ++i) {
    double a[2], b[2];
    const int shared = (i > 0 && compare(&edges[i], &edges[i - 1]) == 0) ||
                       (i + 1 < count && compare(&edges[i], &edges[i + 1]) == 0);
    if (shared) continue;
    screen_place(from, x + 3 * edges[i].low, &a[0], &a[1]);
    screen_place(from, x + 3 * edges[i].high, &b[0], &b[1]);
    add_stroke(out, from, a, b, width, blood);
    *right = fmax(*right, fmax(a[0], b[0]));
  }
  free(edges);
}

/* The mean height of the triangles on the screen. */
static double height_of(const eye *from, const mvs_view *faces, const double *x) {
  const uint32_t *t = faces->data;
  double sum = 0, across, up;
  uint64_t i;
  for (i = 0; i < 3 * faces->count; ++i) {
    screen_place(from, x + 3 * t[i], &across, &up);
    sum += up;
  }
  return sum / (3 * (double)faces->count);
}

/* The area beside the orifice, on a light plate so that it can be read before any tissue. */
static void show_area(scene *out, const eye *from, double x, double y, double area) {
  const double digits = 0.06, margin = 0.03;
  char text[32];
  double low[2], high[2];
  snprintf(text, sizeof text, "%.1f mm^", 1e6 * area);
  low[0] = x;
  low[1] = y - 0.5 * digits - margin;
  high[0] = x + text_width(text, digits) + 2 * margin;
  high[1] = y + 0.5 * digits + margin;
  add_plate(out, from, low, high, paper, 0.8);
  add_text(out, from, x + margin, y - 0.5 * digits, digits, text, blood);
}

void show_orifice(scene *out, const eye *from, const orifice *hole) {
  mvs_view faces;
  const double *x;
  const uint32_t *t;
  double right = -from->aspect;
  uint64_t i;
  if (!hole->valve || !hole->under_load || hole->area < SEALED) return;
  faces = view(hole->valve, MVS_ARRAY_ORIFICE_TRIANGLES);
  x = view(hole->valve, MVS_ARRAY_ORIFICE_VERTICES).data;
  t = faces.data;
  if (faces.count == 0) return;
  for (i = 0; i < 3 * faces.count; ++i) {
    add_corner(out, x + 3 * t[i], blood, 1, hole->at_rest ? 0.7 : 0.35);
  }
  show_outline(out, from, &faces, x, hole->at_rest ? 0.010 : 0.006, &right);
  if (hole->at_rest) show_area(out, from, right + 0.05, height_of(from, &faces, x), hole->area);
}
