/* Software rasteriser with a depth buffer and 2 x 2 supersampling: writes triangles into a picture
 * file without a display. */
#include <stdio.h>
#include <stdlib.h>

#include "phantom.h"

enum { WIDTH = 640, HEIGHT = 480, FINE = 2, WIDE = WIDTH * FINE, HIGH = HEIGHT * FINE };

static const float background[3] = BACKGROUND;

typedef struct pixel {
  float depth, colour[3];
} pixel;

/* A corner on the screen: x and y in pixels, z is the depth. */
typedef struct spot {
  float at[3];
  const float *colour;
} spot;

/* False behind the eye. */
static int project(const float m[16], const corner *c, spot *out) {
  float p[4];
  int k;
  for (k = 0; k < 4; ++k) {
    p[k] = m[k] * c->at[0] + m[4 + k] * c->at[1] + m[8 + k] * c->at[2] + m[12 + k];
  }
  out->at[0] = (p[0] / p[3] + 1) * 0.5f * WIDE;
  out->at[1] = (1 - p[1] / p[3]) * 0.5f * HIGH;
  out->at[2] = p[2] / p[3];
  out->colour = c->colour;
  return p[3] > 1e-3f;
}

/* Twice the signed area of the triangle a b (x, y). */
static float area(const spot *a, const spot *b, float x, float y) {
  return (b->at[0] - a->at[0]) * (y - a->at[1]) - (b->at[1] - a->at[1]) * (x - a->at[0]);
}

/* `over` ignores the depth of the picture and leaves it. */
static void paint_pixel(pixel *to, const spot s[3], const float weight[3], int over) {
  float depth = 0, colour[4] = {0, 0, 0, 0};
  int k, c;
  for (k = 0; k < 3; ++k) depth += weight[k] * s[k].at[2];
  if (depth < -1 || (!over && depth >= to->depth)) return;
  if (!over) to->depth = depth;
  for (c = 0; c < 4; ++c) {
    for (k = 0; k < 3; ++k) colour[c] += weight[k] * s[k].colour[c];
  }
  for (c = 0; c < 3; ++c) to->colour[c] += colour[3] * (colour[c] - to->colour[c]);
}

/* The first and last pixel of the bounding box of a triangle along an axis. */
static void pixel_range(const spot s[3], int axis, int size, int *first, int *last) {
  float low = s[0].at[axis], high = low;
  int k;
  for (k = 1; k < 3; ++k) {
    if (s[k].at[axis] < low) low = s[k].at[axis];
    if (s[k].at[axis] > high) high = s[k].at[axis];
  }
  *first = low < 0 ? 0 : low > (float)size ? size : (int)low;
  *last = high < 0 ? -1 : high >= (float)size ? size - 1 : (int)high;
}

static void paint_triangle(pixel *pixels, const spot s[3], int over) {
  const float whole = area(&s[0], &s[1], s[2].at[0], s[2].at[1]);
  int x, y, left, right, top, bottom, k;
  if (whole == 0) return;
  pixel_range(s, 0, WIDE, &left, &right);
  pixel_range(s, 1, HIGH, &top, &bottom);
  for (y = top; y <= bottom; ++y) {
    for (x = left; x <= right; ++x) {
      float weight[3];
      for (k = 0; k < 3; ++k) {
        weight[k] =
            area(&s[(k + 1) % 3], &s[(k + 2) % 3], (float)x + 0.5f, (float)y + 0.5f) / whole;
      }
      if (weight[0] < 0 || weight[1] < 0 || weight[2] < 0) continue;
      paint_pixel(&pixels[y * WIDE + x], s, weight, over);
    }
  }
}

static void average(const pixel *pixels, unsigned char *rgb) {
  int x, y, c, k;
  for (y = 0; y < HEIGHT; ++y) {
    for (x = 0; x < WIDTH; ++x) {
      for (c = 0; c < 3; ++c) {
        float sum = 0;
        for (k = 0; k < FINE * FINE; ++k) {
          sum += pixels[(y * FINE + k / FINE) * WIDE + x * FINE + k % FINE].colour[c];
        }
        rgb[3 * (y * WIDTH + x) + c] = (unsigned char)(255 * sum / (FINE * FINE));
      }
    }
  }
}

int picture_write(const char *path, const unsigned char *rgb, int width, int height) {
  FILE *file = fopen(path, "wb");
  const size_t size = 3 * (size_t)width * (size_t)height;
  int good;
  if (!file) return 0;
  good = fprintf(file, "P6\n%d %d\n255\n", width, height) > 0 && fwrite(rgb, 1, size, file) == size;
  return fclose(file) == 0 && good;
}

int picture_paint(const scene *what, const eye *from, const char *path) {
  pixel *pixels = malloc(sizeof(pixel) * WIDE * HIGH);
  unsigned char *rgb = malloc(3 * WIDTH * HEIGHT);
  float matrix[16];
  size_t i;
  int good = pixels && rgb;
  for (i = 0; good && i < WIDE * HIGH; ++i) {
    pixels[i].depth = 1;
    pixels[i].colour[0] = background[0];
    pixels[i].colour[1] = background[1];
    pixels[i].colour[2] = background[2];
  }
  eye_matrix(from, matrix);
  for (i = 0; good && i + 2 < what->count; i += 3) {
    spot s[3];
    if (project(matrix, &what->corners[i], &s[0]) & project(matrix, &what->corners[i + 1], &s[1]) &
        project(matrix, &what->corners[i + 2], &s[2])) {
      paint_triangle(pixels, s, i >= what->solid);
    }
  }
  if (good) average(pixels, rgb);
  good = good && picture_write(path, rgb, WIDTH, HEIGHT);
  free(pixels);
  free(rgb);
  return good;
}
