/* A stroke font: each character is a few polylines on a grid, so that the window and the software
 * renderer draw the same text as triangles, without a font library. */
#include <string.h>

#include "draw.h"

/* Points "xy" of a grid of 5 x 10: y = 2 is the baseline, 6 the top of small letters, 8 that of
 * digits. A bar begins a new line. */
static const struct {
  char name;
  const char *lines;
} glyphs[] = {{'0', "12 03 07 18 38 47 43 32 12"},
              {'1', "06 28 22|02 42"},
              {'2', "07 18 38 47 46 02 42"},
              {'3', "07 18 38 47 46 35 25|35 44 43 32 12 03"},
              {'4', "32 38 04 44"},
              {'5', "48 08 05 35 44 43 32 12 03"},
              {'6', "47 38 18 07 03 12 32 43 44 35 05"},
              {'7', "08 48 12"},
              {'8', "15 06 07 18 38 47 46 35 15 04 03 12 32 43 44 35"},
              {'9', "03 12 32 43 47 38 18 07 06 15 45"},
              {'.', "22 22"},
              {'-', "05 45"},
              {'%', "02 48|08 18 17 07 08|32 42 43 33 32"},
              {'^', "09 19 28 06 26"},
              {'a', "16 36 45 42|44 14 03 12 32 43"},
              {'c', "45 36 16 05 03 12 32 43"},
              {'d', "48 42|45 36 16 05 03 12 32 43"},
              {'e', "04 44 45 36 16 05 03 12 32 43"},
              {'f', "48 38 27 22|06 46"},
              {'g', "46 41 30 10|45 36 16 05 03 12 32 43"},
              {'h', "08 02|05 16 36 45 42"},
              {'i', "26 22|28 28"},
              {'l', "28 23 32"},
              {'m', "02 06|05 16 25 22|25 36 45 42"},
              {'n', "02 06|05 16 36 45 42"},
              {'o', "16 05 03 12 32 43 45 36 16"},
              {'r', "02 06|04 26 36 45"},
              {'s', "45 36 16 05 14 34 43 32 12 03"},
              {'t', "18 13 22 32|06 36"},
              {'v', "06 22 46"}};

/* In units of the grid: height of a digit, step to the next character, width of a line. */
#define DIGIT_HEIGHT 6.0
#define STEP 6.0
#define LINE 0.9

static const char *lines_of(char name) {
  size_t i;
  for (i = 0; i < sizeof glyphs / sizeof glyphs[0]; ++i) {
    if (glyphs[i].name == name) return glyphs[i].lines;
  }
  return "";
}

void add_text(scene *out, const eye *from, double x, double y, double height, const char *text,
              const tint colour) {
  const double size = height / DIGIT_HEIGHT;
  size_t i;
  for (i = 0; text[i] != 0; ++i) {
    const double left = x + STEP * size * (double)i;
    const char *p = lines_of(text[i]);
    for (; strlen(p) >= 5; p += 3) { /* "xy xy": a line between two points */
      const double a[2] = {left + size * (p[0] - '0'), y + size * (p[1] - '2')};
      const double b[2] = {left + size * (p[3] - '0'), y + size * (p[4] - '2')};
      if (p[2] != '|') add_stroke(out, from, a, b, LINE * size, colour);
    }
  }
}

double text_width(const char *text, double height) {
  const size_t count = strlen(text);
  return count == 0 ? 0 : ((double)count * STEP - 2) * height / DIGIT_HEIGHT;
}
