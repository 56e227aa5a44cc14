/* The channel from a program's window to the driver mouse: one struct in POSIX shared memory, which
 * the window's thread writes and the servo's thread reads, without a lock. For C99 and C++; copy
 * it.
 *
 *   int fd = shm_open("/mine", O_RDWR | O_CREAT | O_EXCL, 0600);
 *   ftruncate(fd, sizeof(mouse_pointer));
 *   mouse_pointer *p = mmap(NULL, sizeof *p, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
 *   mouse_pointer_publish(p);
 *   desc.driver = "mouse"; desc.options = "pointer=/mine"; mvs_device_open(&desc, &device);
 *   shm_unlink("/mine");                              the driver keeps its own mapping
 *   ... at each event of the window: mouse_pointer_write(p, position, buttons);
 *   mouse_pointer_end(p);                             before the window closes
 *
 * The struct is a sequence lock. Only one thread writes it. The fields are written with release and
 * read with acquire order, so that no fence is needed (H.-J. Boehm, Can seqlocks get along with
 * programming language memory models?, MSPC 2012). A reader never waits: it keeps its last sample
 * if the writer is interrupted between the two steps of the sequence. */
#ifndef MVS_MOUSE_POINTER_H
#define MVS_MOUSE_POINTER_H

#include <stdint.h>

#define MOUSE_POINTER_MAGIC 0x7074726du /* "mrtp" in memory; version 1 of this struct */

enum { MOUSE_POINTER_LEFT = 1, MOUSE_POINTER_RIGHT = 2, MOUSE_POINTER_MIDDLE = 4 };

typedef struct mouse_pointer {
  uint32_t magic;     /* MOUSE_POINTER_MAGIC once the struct is valid */
  uint32_t size;      /* bytes of the writer's struct, which grows at its end only */
  uint32_t sequence;  /* odd while the fields below change; 0: no event yet */
  uint32_t buttons;   /* MOUSE_POINTER_*; the left one is button 0 of the device */
  double position[3]; /* m: x to the right, y up, z towards the user, 0 in the middle */
  uint32_t ended;     /* 1: the window is closed */
  uint32_t reserved;
} mouse_pointer;

/* Makes zeroed memory valid. */
static inline void mouse_pointer_publish(mouse_pointer *to) {
  to->size = sizeof *to;
  __atomic_store_n(&to->magic, MOUSE_POINTER_MAGIC, __ATOMIC_RELEASE);
}

/* Sets the target of the hand. */
static inline void mouse_pointer_write(mouse_pointer *to, const double position[3],
                                       uint32_t buttons) {
  const uint32_t before = __atomic_load_n(&to->sequence, __ATOMIC_RELAXED);
  int k;
  __atomic_store_n(&to->sequence, before + 1, __ATOMIC_RELAXED);
  for (k = 0; k < 3; ++k) {
    double coordinate = position[k];
    __atomic_store(&to->position[k], &coordinate, __ATOMIC_RELEASE);
  }
  __atomic_store_n(&to->buttons, buttons, __ATOMIC_RELEASE);
  __atomic_store_n(&to->sequence, before + 2, __ATOMIC_RELEASE);
}

static inline void mouse_pointer_end(mouse_pointer *to) {
  __atomic_store_n(&to->ended, 1, __ATOMIC_RELEASE);
}

/* Reads the fields as one write left them. Returns 0, without them, before the first write and in
 * the middle of one. */
static inline int mouse_pointer_read(const mouse_pointer *from, double position[3],
                                     uint32_t *buttons) {
  const uint32_t before = __atomic_load_n(&from->sequence, __ATOMIC_ACQUIRE);
  double p[3];
  uint32_t b;
  int k;
  if (before == 0 || before % 2 == 1) return 0;
  for (k = 0; k < 3; ++k) __atomic_load(&from->position[k], &p[k], __ATOMIC_ACQUIRE);
  b = __atomic_load_n(&from->buttons, __ATOMIC_ACQUIRE);
  if (__atomic_load_n(&from->sequence, __ATOMIC_RELAXED) != before) return 0;
  for (k = 0; k < 3; ++k) position[k] = p[k];
  *buttons = b;
  return 1;
}

static inline int mouse_pointer_ended(const mouse_pointer *from) {
  return __atomic_load_n(&from->ended, __ATOMIC_ACQUIRE) != 0;
}

#endif
