/* Primitives of the picture: vectors, lit shapes in the valve, and flat shapes on the screen. */
#ifndef PHANTOM_DRAW_H
#define PHANTOM_DRAW_H

#include "phantom.h"

typedef float tint[3];

double dot(const double a[3], const double b[3]);
void cross(const double a[3], const double b[3], double out[3]);
/* to = a + t b */
void along(const double a[3], double t, const double b[3], double to[3]);
/* Scales to length 1 and returns the length before. */
double unit(double v[3]);

/* An array of a snapshot. */
mvs_view view(const mvs_snapshot *valve, uint32_t which);

/* Adds a corner of a triangle; `light` scales its colour, `alpha` 1 is opaque. */
void add_corner(scene *out, const double at[3], const tint colour, double light, double alpha);
/* Brightness of a surface under a lamp beside the eye, the same on both of its sides. */
double lit(const eye *from, const double normal[3]);
/* A tapered tube with the normals of a cylinder, a tube, and a sphere. */
void add_tube(scene *out, const eye *from, const double a[3], const double b[3],
              const double radius[2], const tint colour);
void add_line(scene *out, const eye *from, const double a[3], const double b[3], double radius,
              const tint colour);
void add_ball(scene *out, const eye *from, const double middle[3], double radius,
              const tint colour);
/* The colour of the strain scale, from 0 to 1. */
void colour_of(double share, tint out);

/* Coordinates of the screen: 0 in the middle, x to the right from -aspect to aspect, y up from -1
 * to 1. The point of the valve behind them in a plane near the eye, and the reverse. */
void screen_point(const eye *from, double x, double y, double at[3]);
void screen_place(const eye *from, const double at[3], double *x, double *y);
/* A rectangle and a line on the screen. */
void add_plate(scene *out, const eye *from, const double low[2], const double high[2],
               const tint colour, double alpha);
void add_stroke(scene *out, const eye *from, const double a[2], const double b[2], double width,
                const tint colour);

/* Writes digits, a few letters and ". - %"; '^' is a raised 2. `height` is that of a digit. */
void add_text(scene *out, const eye *from, double x, double y, double height, const char *text,
              const tint colour);
double text_width(const char *text, double height);

/* The bodies of a convex tool of the valve. */
void show_bodies(scene *out, const mvs_snapshot *valve, const eye *from, const mvs_tool_state *tool,
                 const tint colour);

/* Parts of the picture that lie over the valve. */
void show_scale(scene *out, const eye *from);
void show_orifice(scene *out, const eye *from, const orifice *hole);

#endif
