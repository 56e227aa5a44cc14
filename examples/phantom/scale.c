/* The colour bar of the strain, at the left edge of the picture, with numbers in % on both sides:
 * the same colours span different strains on leaflets and on chordae. */
#include <stdio.h>

#include "draw.h"

/* Coordinates of the screen, in the corner that the valve leaves free. LEFT is the distance of the
 * bar from the left edge. */
#define LEFT 0.35
#define WIDTH 0.05
#define LOW (-0.76)
#define HIGH (-0.06)
#define DIGITS 0.042 /* height */
#define GAP 0.035    /* between bar and number */

enum { PARTS = 64, MARKS = 5 };

static const tint ink = {0.15f, 0.15f, 0.18f}, paper = BACKGROUND;

/* Strain, in %, at a mark. */
static void number_of(double full, int mark, char text[16]) {
  snprintf(text, 16, "%g", 100 * full * mark / MARKS);
}

/* Writes a text that ends at x, or that begins there. */
static void write_beside(scene *out, const eye *from, double x, double y, int ends,
                         const char *text) {
  const double from_x = ends ? x - text_width(text, DIGITS) : x;
  add_text(out, from, from_x, y - 0.5 * DIGITS, DIGITS, text, ink);
}

/* A light plate, so that the numbers can be read before the valve. */
static void show_plate(scene *out, const eye *from, double left) {
  const double beside = 2 * GAP + text_width("50", DIGITS);
  const double low[2] = {left - beside, LOW - DIGITS},
               high[2] = {left + WIDTH + beside, HIGH + DIGITS};
  add_plate(out, from, low, high, paper, 0.75);
}

static void show_bar(scene *out, const eye *from, double left) {
  const double part = (HIGH - LOW) / PARTS;
  int i;
  for (i = 0; i < PARTS; ++i) {
    const double low[2] = {left, LOW + i * part}, high[2] = {left + WIDTH, LOW + (i + 1) * part};
    tint colour;
    colour_of((i + 0.5) / PARTS, colour);
    add_plate(out, from, low, high, colour, 1);
  }
}

void show_scale(scene *out, const eye *from) {
  const double left = -from->aspect + LEFT, right = left + WIDTH;
  int i;
  show_plate(out, from, left);
  show_bar(out, from, left);
  for (i = 0; i <= MARKS; ++i) {
    const double y = LOW + (HIGH - LOW) * i / MARKS;
    const double a[2] = {left - 0.4 * GAP, y}, b[2] = {right + 0.4 * GAP, y};
    char text[16];
    add_stroke(out, from, a, b, 0.006, ink);
    number_of(CHORD_STRAIN_FULL, i, text);
    write_beside(out, from, left - GAP, y, 1, text);
    number_of(STRAIN_FULL, i, text);
    write_beside(out, from, right + GAP, y, 0, text);
  }
  write_beside(out, from, left - GAP, LOW - 0.09, 1, "chordae");
  write_beside(out, from, right + GAP, LOW - 0.09, 0, "leaflets");
  add_text(out, from, left + 0.5 * WIDTH - 0.5 * text_width("strain in %", DIGITS), LOW - 0.20,
           DIGITS, "strain in %", ink);
}
