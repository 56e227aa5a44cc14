/* Fixture: a small valve from arrays, a funnel under a round annulus with two heads and ten
 * chordae. */
#ifndef TESTS_FUNNEL_H
#define TESTS_FUNNEL_H

#include <math.h>
#include <mvs/mvs.h>
#include <string.h>

enum {
  FUNNEL_SEGMENTS = 16,
  FUNNEL_ROWS = 4,
  FUNNEL_SHEET = FUNNEL_SEGMENTS * FUNNEL_ROWS,
  FUNNEL_NODES = FUNNEL_SHEET + 2,
  FUNNEL_TRIANGLES = 2 * FUNNEL_SEGMENTS * (FUNNEL_ROWS - 1),
  FUNNEL_CHORDS = 10
};

typedef struct funnel {
  double nodes[FUNNEL_NODES][3];
  uint32_t triangles[FUNNEL_TRIANGLES][3];
  uint32_t leaflet[FUNNEL_TRIANGLES];
  uint32_t annulus[FUNNEL_SEGMENTS];
  mvs_leaflet_desc leaflets[2];
  mvs_chord_desc chords[FUNNEL_CHORDS];
  mvs_head_desc heads[2];
  mvs_valve_desc desc;
} funnel;

static inline mvs_array packed(const void *data, uint64_t count, uint32_t components,
                               uint32_t type) {
  mvs_array array = {data, count, components, type, 0};
  return array;
}

static inline void funnel_sheet(funnel *f) {
  for (uint32_t n = 0; n < FUNNEL_SHEET; ++n) {
    const uint32_t full_rows = n / FUNNEL_SEGMENTS;
    double row = full_rows;
    double turn = 2 * 3.14159265358979 * n / (double)FUNNEL_SEGMENTS;
    double radius = 15e-3 - 2e-3 * row;
    f->nodes[n][0] = radius * cos(turn);
    f->nodes[n][1] = radius * sin(turn);
    f->nodes[n][2] = -6e-3 * row;
  }
  for (uint32_t q = 0; q < FUNNEL_TRIANGLES / 2; ++q) {
    uint32_t row = q / FUNNEL_SEGMENTS, s = q % FUNNEL_SEGMENTS;
    uint32_t a = q, b = row * FUNNEL_SEGMENTS + (s + 1) % FUNNEL_SEGMENTS;
    uint32_t corners[6] = {a, b, a + FUNNEL_SEGMENTS, b, b + FUNNEL_SEGMENTS, a + FUNNEL_SEGMENTS};
    memcpy(&f->triangles[2 * q], corners, sizeof corners);
    f->leaflet[2 * q] = f->leaflet[2 * q + 1] = s < FUNNEL_SEGMENTS / 2 ? 0 : 1;
  }
  for (uint32_t s = 0; s < FUNNEL_SEGMENTS; ++s) f->annulus[s] = s;
}

static inline void funnel_chords(funnel *f) {
  for (uint32_t h = 0; h < 2; ++h) {
    uint32_t node = FUNNEL_SHEET + h;
    f->nodes[node][0] = h ? -8e-3 : 8e-3;
    f->nodes[node][1] = 0;
    f->nodes[node][2] = -25e-3;
    f->heads[h].node = node;
    for (uint32_t k = 0; k < FUNNEL_CHORDS / 2; ++k) {
      mvs_chord_desc *chord = &f->chords[h * FUNNEL_CHORDS / 2 + k];
      uint32_t s = (h * FUNNEL_SEGMENTS / 2 + FUNNEL_SEGMENTS + k - 2) % FUNNEL_SEGMENTS;
      chord->node_a = node;
      chord->node_b = FUNNEL_SHEET - FUNNEL_SEGMENTS + s;
      chord->kind = MVS_CHORD_KIND_MARGINAL;
    }
  }
}

/* Fills in a valve. `f` must stay at its address: the description points into it. */
static inline void make_funnel(funnel *f) {
  memset(f, 0, sizeof *f);
  funnel_sheet(f);
  funnel_chords(f);
  f->leaflets[0].name = "A";
  f->leaflets[1].name = "P";
  f->desc.struct_size = sizeof f->desc;
  f->desc.name = "funnel";
  f->desc.nodes = packed(f->nodes, FUNNEL_NODES, 3, MVS_TYPE_F64);
  f->desc.triangles = packed(f->triangles, FUNNEL_TRIANGLES, 3, MVS_TYPE_U32);
  f->desc.triangle_leaflet = packed(f->leaflet, FUNNEL_TRIANGLES, 1, MVS_TYPE_U32);
  f->desc.annulus = packed(f->annulus, FUNNEL_SEGMENTS, 1, MVS_TYPE_U32);
  f->desc.leaflets = f->leaflets;
  f->desc.leaflet_count = 2;
  f->desc.leaflet_stride = sizeof f->leaflets[0];
  f->desc.chords = f->chords;
  f->desc.chord_count = FUNNEL_CHORDS;
  f->desc.chord_stride = sizeof f->chords[0];
  f->desc.heads = f->heads;
  f->desc.head_count = 2;
  f->desc.head_stride = sizeof f->heads[0];
}

/* Systole for the funnel: a tenth of the pressure, since a tube of tissue has no coaptation. */
static inline mvs_load_case funnel_load(void) {
  mvs_load_case load = {sizeof load, 0, MVS_SYSTOLE_PA / 10, 1};
  return load;
}

#endif
