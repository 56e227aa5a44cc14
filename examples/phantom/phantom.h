/* The parts of phantom.c. Positions are in m, in the coordinates of the valve. */
#ifndef PHANTOM_H
#define PHANTOM_H

#include <mvs/mvs.h>
#include <stddef.h>

/* Exits with the sentence of the library if a call failed. */
void must(mvs_result result);

/* Options of the command line. */
typedef struct options {
  const char *driver, *device, *valve, *keys, *frames, *out;
  char driver_options[4096];        /* "key=value" lines */
  double scale, dt, every, seconds; /* seconds 0: no limit */
  int headless;
} options;
extern options option;
/* Prints the keys. */
void help(void);
/* True for the keys that it prints. */
int is_key(int key);
/* Exits with code 2 for invalid options, with 0 after --help. */
void read_options(int argc, char **argv);
/* Adds a line "key=value" to the options of the driver. */
void add_driver_option(const char *key, const char *value);
/* Reads the first entry of "2.0:u 3.0:s" (key u at 2 s, key s at 3 s); returns the rest, or null
 * without an entry. */
const char *next_key(const char *keys, double *when, int *key);

/* The camera: `up` and `right` on the screen, `back` towards the eye. */
typedef struct eye {
  double middle[3], right[3], up[3], back[3];
  double distance;
  double aspect; /* width of the picture divided by its height */
} eye;

/* Half the height of the picture at distance 1: the field of view is 30 degrees. */
#define EYE_SLOPE 0.26794919243112270647

/* The surgeon's view, from the atrium with the anterior leaflet on top, turned about the valve's
 * axis and tilted away from it (rad). */
eye eye_of_surgeon(const mvs_snapshot *valve, double turn, double tilt, double distance,
                   double aspect);

/* Maps a device to the surgeon's view: right to right, up to out of the valve, towards the user to
 * down. */
mvs_device_view map_of_surgeon(const mvs_snapshot *valve, double scale);

/* The projection matrix for column vectors in column-major order, as OpenGL needs it. */
void eye_matrix(const eye *from, float matrix[16]);

#define BACKGROUND \
  { 0.93f, 0.94f, 0.96f }

/* Coloured and lit triangles, three corners each. Those from `solid` on are drawn over all others,
 * in their order and mixed with the colours behind them. */
typedef struct corner {
  float at[3], colour[4]; /* red green blue alpha */
} corner;
typedef struct scene {
  corner *corners;
  size_t count, solid, room;
} scene;

/* The orifice of a measured valve. It may be graded only of a valve at rest under load. */
typedef struct orifice {
  double area; /* m2 */
  int at_rest, under_load;
  const mvs_snapshot *valve; /* null: not yet measured */
} orifice;

/* The convex instruments of the hand: a hook, a spatula, a sizer. instrument_give fills in the
 * bodies of the present one, instrument_next takes the next; both return its name. */
const char *instrument_give(mvs_device_hand *to);
const char *instrument_next(void);

/* Objects to show besides the valve. */
typedef struct sight {
  int strain;           /* 1: colours show strain, 0: anatomy */
  mvs_id chord;         /* highlighted chord; 0: no chord */
  double hand[3];       /* m */
  double force[3];      /* N, on the hand: an arrow of 5 mm/N */
  mvs_tool_state tool;  /* kind 0: no tool */
  const double *marked; /* position to mark; nullable */
  orifice orifice;
} sight;

/* Strain at the upper end of the colour scale of leaflets and of chordae. */
#define STRAIN_FULL 0.5
#define CHORD_STRAIN_FULL 0.05

/* Rebuilds the triangles. */
void scene_build(scene *out, const mvs_snapshot *valve, const eye *from, const sight *what);

/* Measures a snapshot, on a second thread unless `wait` is set; skips it if that thread is busy. */
void orifice_look(const mvs_snapshot *valve, int wait);
/* The orifice of the last measured snapshot; the caller releases its valve. */
orifice orifice_last(void);
/* Its area, m2. */
double orifice_area(void);
void orifice_close(void);

/* Messages. */
void log_line(double time, const char *format, ...);
void log_device(const mvs_device_info *info);
void log_events(mvs_sim *sim, const mvs_device_report *hand, const mvs_device_state *now);
/* `motors`: the device can push, so that the state of its forces matters. */
void write_title(char *text, size_t size, uint32_t mode, int motors, const mvs_device_report *hand,
                 const mvs_device_state *now);
const char *mode_name(uint32_t mode);
const char *chord_name(mvs_sim *sim, mvs_id id, mvs_part *part);
double length_of(const double v[3]);
/* The orifice, m2: of the present valve (takes about 30 ms), or without `wait` of the last
 * measured. */
double orifice_now(mvs_sim *sim, int wait);

/* Executes the action of a key on the valve and returns its description; null for other keys. `out`
 * is the path of output files without their endings. */
const char *surgery(mvs_sim *sim, int key, const mvs_device_report *hand, mvs_id chord,
                    const char *out);
/* Sets the length of a chord so that its end reaches a point. */
const char *surgery_drag(mvs_sim *sim, mvs_id chord, const double to[3]);
void surgery_help(void);
int is_surgery_key(int key);

/* Renders into a PPM file without a window system; 0 if it cannot be written. */
int picture_paint(const scene *what, const eye *from, const char *path);
int picture_write(const char *path, const unsigned char *rgb, int width, int height);

/* The pointer of the window, in coordinates of the screen: x from -aspect to aspect, y from -1 to 1
 * upwards. */
typedef struct pointer {
  double x, y;
  double notches; /* of the wheel since the last call, positive away from the user */
  int left;       /* the left button is down */
  int right;      /* the right button was pressed since the last call */
} pointer;

/* The driver mouse. mouse_open creates the shared memory between window and driver and returns the
 * value of the driver's option `pointer`, or exits; mouse_opened removes the name of that memory
 * once the driver has it; mouse_close ends the driver's device. */
const char *mouse_open(void);
void mouse_opened(void);
void mouse_close(void);
int mouse_is_open(void);
/* Moves the hand of the driver under the pointer. */
void mouse_move(mvs_device *device, const mvs_snapshot *valve, const eye *from, const pointer *to);

/* Opens the window. Returns null on success, else the reason of the failure. */
const char *window_open(int width, int height);
/* The character of the next pressed key; 0: no key. */
int window_key(void);
int window_wants_to_close(void);
/* Its width divided by its height. */
double window_aspect(void);
/* Reads its pointer; returns 0 if that has not changed since the last call. */
int window_pointer(pointer *now);
/* Handles user input for at most this time. */
void window_wait(double seconds);
/* Shows the scene and, if `path` is not null, writes it into a PPM file; 0 if that fails. */
int window_show(const scene *what, const eye *from, const char *title, const char *path);
void window_close(void);

#endif
