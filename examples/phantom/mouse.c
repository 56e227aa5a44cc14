/* The hand of the driver mouse: it is always under the pointer of the window, in a plane of view.
 *
 * The wheel moves this plane along the line of sight; the right button moves it to the tissue under
 * the pointer. When the view turns, the new plane passes through the hand. The target goes to the
 * driver through shared memory (haptic_drivers/mouse/pointer.h), which the driver filters. */
#define _POSIX_C_SOURCE 200809L /* shm_open, ftruncate. NOLINT */
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "../../haptic_drivers/mouse/pointer.h"
#include "draw.h"

#define NOTCH 1e-3    /* m, of the wheel */
#define DEEPEST 45e-3 /* m, from the middle of the view, of the plane of the hand */

static mouse_pointer *channel;
static char name[64]; /* of the shared memory, until it is unlinked */
static double target[3];
static int started;

static int create(void) {
  int file = -1, attempt;
  for (attempt = 0; file < 0 && attempt < 100; ++attempt) {
    snprintf(name, sizeof name, "/mvs-phantom-%ld-%d", (long)getpid(), attempt);
    file = shm_open(name, O_RDWR | O_CREAT | O_EXCL, 0600);
  }
  return file;
}

const char *mouse_open(void) {
  const int file = create();
  void *place = MAP_FAILED;
  if (file >= 0 && ftruncate(file, sizeof *channel) == 0) {
    place = mmap(NULL, sizeof *channel, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  }
  if (place == MAP_FAILED) {
    fprintf(stderr, "phantom: no shared memory for the pointer (%s): is /dev/shm mounted?\n",
            strerror(errno));
    exit(1);
  }
  close(file);
  channel = place;
  mouse_pointer_publish(channel);
  return name;
}

void mouse_opened(void) {
  if (name[0] != 0) shm_unlink(name);
  name[0] = 0;
}

void mouse_close(void) {
  mouse_opened();
  if (channel) mouse_pointer_end(channel);
}

int mouse_is_open(void) {
  return channel != NULL;
}

/* The distance along a ray to a triangle, infinite if the ray misses it (Moeller and Trumbore,
 * Fast, minimum storage ray-triangle intersection, 1997). */
static double distance_to(const double eye_at[3], const double ray[3], const double a[3],
                          const double b[3], const double c[3]) {
  double ab[3], ac[3], s[3], p[3], q[3], det, u, v;
  along(b, -1, a, ab);
  along(c, -1, a, ac);
  along(eye_at, -1, a, s);
  cross(ray, ac, p);
  cross(s, ab, q);
  det = dot(ab, p);
  if (det == 0) return INFINITY;
  u = dot(s, p) / det;
  v = dot(ray, q) / det;
  return u < 0 || v < 0 || u + v > 1 ? INFINITY : dot(ac, q) / det;
}

/* The depth (along `back`, from the middle of the view) of the tissue nearest to the eye on a ray
 * of depth -1; `otherwise` without tissue there. */
static double depth_of_tissue(const mvs_snapshot *valve, const eye *from, const double ray[3],
                              double otherwise) {
  const mvs_view faces = view(valve, MVS_ARRAY_TRIANGLE_NODES);
  const double *const x = view(valve, MVS_ARRAY_NODE_POSITION).data;
  const uint32_t *t = faces.data;
  double eye_at[3], nearest = INFINITY;
  uint64_t i;
  along(from->middle, from->distance, from->back, eye_at);
  for (i = 0; i < faces.count; ++i, t += 3) {
    const double far = distance_to(eye_at, ray, x + 3 * t[0], x + 3 * t[1], x + 3 * t[2]);
    if (far > 0) nearest = fmin(nearest, far);
  }
  return isfinite(nearest) ? from->distance - nearest : otherwise;
}

/* The inverse of the map of mvs_device_view: p_device = q* (p - origin) q / (|q|^2 scale). */
static void to_device(const mvs_device_view *map, const double p[3], double out[3]) {
  const double *const q = map->rotation, w = q[0], axis[3] = {-q[1], -q[2], -q[3]};
  const double square = w * w + dot(axis, axis);
  double v[3], twice[3], turned[3];
  along(p, -1, map->origin, v);
  cross(axis, v, twice);
  along(twice, w, v, twice); /* axis x v + w v */
  cross(axis, twice, turned);
  along(v, 2 / square, turned, out); /* Rodrigues' formula for a unit quaternion, scaled */
  out[0] /= map->scale;
  out[1] /= map->scale;
  out[2] /= map->scale;
}

void mouse_move(mvs_device *device, const mvs_snapshot *valve, const eye *from, const pointer *to) {
  mvs_device_view map = {0};
  double ray[3] = {0, 0, 0}, offset[3], depth, at[3];
  map.struct_size = sizeof map;
  must(mvs_device_get_view(device, &map));
  if (!started) memcpy(target, map.origin, sizeof target);
  along(target, -1, from->middle, offset);
  depth = dot(offset, from->back);
  along(ray, -1, from->back, ray);
  along(ray, EYE_SLOPE * to->x, from->right, ray);
  along(ray, EYE_SLOPE * to->y, from->up, ray);
  if (!started || to->right) depth = depth_of_tissue(valve, from, ray, depth);
  started = 1;
  depth = fmax(-DEEPEST, fmin(fmin(DEEPEST, 0.7 * from->distance), depth - NOTCH * to->notches));
  along(from->middle, from->distance, from->back, target);
  along(target, from->distance - depth, ray, target);
  to_device(&map, target, at);
  mouse_pointer_write(channel, at, to->left ? MOUSE_POINTER_LEFT : 0);
}
