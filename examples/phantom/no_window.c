/* Replaces window.c in builds without GLFW: there is no window. */
#include "phantom.h"

const char *window_open(int width, int height) {
  (void)width;
  (void)height;
  return "built without GLFW (libglfw3-dev)";
}

int window_key(void) {
  return 0;
}

int window_wants_to_close(void) {
  return 0;
}

double window_aspect(void) {
  return 4.0 / 3;
}

int window_pointer(pointer *now) {
  (void)now;
  return 0;
}

void window_wait(double seconds) {
  (void)seconds;
}

int window_show(const scene *what, const eye *from, const char *title, const char *path) {
  (void)what;
  (void)from;
  (void)title;
  (void)path;
  return 0;
}

void window_close(void) {}
