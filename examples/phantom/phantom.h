/* What phantom.c shows, and what shows it. Places are in m, in the valve's coordinates. */
#ifndef PHANTOM_H
#define PHANTOM_H

#include <mvs/mvs.h>
#include <stddef.h>

/* Ends the program with the library's sentence unless all went well. */
void must(mvs_result result);

/* What the command line says. */
typedef struct options {
  const char *driver, *device, *valve, *keys, *frames, *out;
  char driver_options[4096];        /* "key=value" lines */
  double scale, dt, every, seconds; /* seconds 0: no end */
  int headless;
} options;
extern options option;
/* Ends the program with code 2 if that makes no sense. */
void read_options(int argc, char **argv);
/* The first of "2.0:u 3.0:s", key u at 2 s, key s at 3 s, and where the others begin; null: none.
 */
const char *next_key(const char *keys, double *when, int *key);

/* From where the valve is looked at: with `up` and `right` on the screen, `back` towards the eye.
 */
typedef struct eye {
  double middle[3], right[3], up[3], back[3];
  double distance;
} eye;

/* The surgeon's view, from the atrium with the anterior leaflet on top, turned about the valve's
 * axis and tilted away from it (rad). */
eye eye_of_surgeon(const mvs_snapshot *valve, double turn, double tilt, double distance);

/* Places on the screen, as OpenGL wants them: a matrix for column vectors, column by column. */
void eye_matrix(const eye *from, double aspect, float matrix[16]);

#define BACKGROUND \
  { 0.93f, 0.94f, 0.96f }

/* Coloured and lit triangles, three corners each. */
typedef struct corner {
  float at[3], colour[3];
} corner;
typedef struct scene {
  corner *corners;
  size_t count, room;
} scene;

/* What to show besides the valve. */
typedef struct sight {
  int strain;                  /* 1: colours tell strain, 0: anatomy */
  mvs_id chord;                /* to stand out; 0: none */
  double hand[3];              /* m */
  double force[3];             /* N, on the hand: an arrow of 5 mm a newton */
  mvs_tool_state tool;         /* kind 0: none */
  const double *marked;        /* a place to mark, null: none */
  const mvs_snapshot *orifice; /* of which to show the orifice, null: none */
} sight;

/* The strain at the end of the colours, of leaflets and of chordae. */
#define STRAIN_FULL 0.5
#define CHORD_STRAIN_FULL 0.05

/* Makes the triangles anew. */
void scene_build(scene *out, const mvs_snapshot *valve, const eye *from, const sight *what);

/* Measures a snapshot, beside the program unless it is to wait. What is at work goes first. */
void orifice_look(const mvs_snapshot *valve, int wait);
/* Of the last snapshot that was measured, m2; that snapshot to release, where `of` is not null. */
double orifice_area(const mvs_snapshot **of);
void orifice_close(void);

/* What happens, in words. */
void tell(double time, const char *format, ...);
void tell_events(mvs_sim *sim, const mvs_device_report *hand, const mvs_device_state *now);
void write_title(char *text, size_t size, uint32_t mode, int strain, const mvs_device_report *hand,
                 const mvs_device_state *now);
const char *mode_name(uint32_t mode);
const char *chord_name(mvs_sim *sim, mvs_id id, mvs_part *part);
double length_of(const double v[3]);
/* The orifice as it is now, m2, which takes some 30 ms; without waiting as it was last measured. */
double orifice_now(mvs_sim *sim, int wait);

/* Does what a key means to the valve, and says what that was; null if it means nothing. `out` is
 * the path of files to write, without its end. */
const char *surgery(mvs_sim *sim, int key, const mvs_device_report *hand, mvs_id chord,
                    const char *out);
/* Sets the length of a chord as its end was dragged. */
const char *surgery_drag(mvs_sim *sim, mvs_id chord, const double to[3]);
void surgery_help(void);

/* Paints without any window system, into a PPM file; 0 if it cannot be written. */
int picture_paint(const scene *what, const eye *from, const char *path);
int picture_write(const char *path, const unsigned char *rgb, int width, int height);

/* The window. Null if there is one now, else the reason why not. */
const char *window_open(int width, int height);
/* The next key that was pressed, as the character that it types; 0: none. */
int window_key(void);
int window_wants_to_close(void);
/* Handles what the user does for at most a time. */
void window_wait(double seconds);
/* Shows, and writes what is shown into a PPM file where `path` is not null; 0 if it cannot be. */
int window_show(const scene *what, const eye *from, const char *title, const char *path);
void window_close(void);

#endif
