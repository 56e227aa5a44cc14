/* The user interface of the founding paper (Tenenholtz et al. 2011): a hand in a mitral valve. The
 * hand grasps and pushes leaflets, feels and drags chordae; keys colour strain, operate, undo,
 * save.
 * Build: cc -std=c99 phantom.c phantom/[!nw]*.c phantom/no_window.c -o phantom -lm -lrt -pthread \
 *          $(pkg-config --cflags --libs mvs)     (with a window: see CMakeLists.txt)
 * Use:   ./phantom [--driver NAME] [--valve FILE]; see README.md; ./phantom --help prints all
 * options. Without --driver the mouse moves the hand. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "phantom/phantom.h"

static mvs_sim *sim;
static mvs_device *device;
static mvs_device_report hand = {.struct_size = sizeof hand};
static mvs_device_state now = {.struct_size = sizeof now};
static mvs_id chosen; /* chord, for operations */
static uint32_t mode;
static int window, strain = 1, ended, frames, motors;
static double turn, tilt = 0.7, distance = 0.088; /* of the view: rad, rad, m */
static double tissue_time, frame_time, strongest; /* s, s, N */

void must(mvs_result result) {
  if (result == MVS_OK) return;
  fprintf(stderr, "phantom: %s\n", mvs_last_error()->message);
  exit(1);
}

/* At every exit: no force stays on the device. */
static void close_device(void) {
  mvs_device_close(device);
  device = NULL;
  mouse_close();
}

static const mvs_snapshot *present(void) {
  const mvs_snapshot *valve;
  must(mvs_get_snapshot(sim, &valve));
  return valve;
}

/* Prints and handles the events of the hand. */
static void take_events(void) {
  log_events(sim, &hand, &now);
  strongest = fmax(strongest, length_of(hand.force));
  if (hand.events & MVS_EVENT_CHOSEN) chosen = hand.chord;
  if (hand.events & MVS_EVENT_DRAGGED) {
    log_line(now.time, "%s", surgery_drag(sim, hand.chord, hand.drag_to));
  }
}

static void set_mode(uint32_t wanted, mvs_id chord) {
  mvs_device_hand tool = {.struct_size = sizeof tool, .mode = wanted, .chord = chord};
  mode = wanted;
  if (mode == MVS_HAND_MODE_CONVEX) log_line(now.time, "takes the %s", instrument_give(&tool));
  must(mvs_device_set_hand(device, &tool));
  log_line(now.time, "the hand %s", mode_name(mode));
}

void help(void) {
  printf(
      "  1 view  2 grasp  3 push with a ball  4 with a rod  5 feel a chord  6 drag a chord\n"
      "  7 push with an instrument   i  the next one: hook, spatula, sizer\n"
      "  a  forces on   space  forces off   n  select the chord nearest to the hand\n"
      "  c  strain or anatomy   arrows, or h j k l, rotate the view; z Z zoom in and out\n"
      "  driver mouse: left button grasps, wheel moves away and near, right button to the "
      "tissue\n");
  surgery_help();
  printf("  ?  help   q  quit\n");
}

int is_key(int key) {
  return strchr("1234567ia nchljkzZ?q", key) != NULL || is_surgery_key(key);
}

static void choose_chord(void) {
  mvs_part part = {0};
  chosen = hand.near_chord;
  log_line(now.time, "selects chord %s", chord_name(sim, chosen, &part));
  set_mode(mode, chosen);
}

static void press(int key) {
  const char *said;
  if (key >= '1' && key <= '7')
    set_mode((uint32_t)(key - '1'), 0);
  else if (key == 'i')
    instrument_next(), set_mode(MVS_HAND_MODE_CONVEX, 0);
  else if (key == 'a')
    log_line(now.time, "%s", mvs_device_arm(device) ? mvs_last_error()->message : "armed");
  else if (key == ' ')
    must(mvs_device_cut(device));
  else if (key == 'n')
    choose_chord();
  else if (key == 'c')
    strain = !strain;
  else if (key == 'h' || key == 'l')
    turn += key == 'h' ? -0.2 : 0.2;
  else if (key == 'j' || key == 'k')
    tilt += key == 'j' ? -0.2 : 0.2;
  else if (key == 'z' || key == 'Z')
    distance *= key == 'z' ? 0.9 : 1 / 0.9;
  else if (key == '?')
    help();
  else if (key == 'q')
    ended = 1;
  else if ((said = surgery(sim, key, &hand, chosen, option.out)) != NULL) {
    log_line(now.time, "%s; orifice %.1f mm2", said, 1e6 * orifice_now(sim, option.headless));
  }
}

static void press_due_keys(void) {
  const char *rest;
  double when;
  int key;
  while ((rest = next_key(option.keys, &when, &key)) != NULL && when <= now.time) {
    option.keys = rest;
    press(key);
  }
}

static eye present_eye(const mvs_snapshot *valve) {
  return eye_of_surgeon(valve, turn, tilt, distance, window ? window_aspect() : 4.0 / 3);
}

/* Moves the hand of the driver mouse. */
static void follow_pointer(void) {
  pointer to;
  const mvs_snapshot *valve;
  eye from;
  if (!mouse_is_open() || !window_pointer(&to)) return;
  valve = present();
  from = present_eye(valve);
  mouse_move(device, valve, &from, &to);
  mvs_snapshot_release(valve);
}

/* Shows the valve in the window, and writes a due frame. */
static void show(void) {
  static scene triangles;
  const mvs_snapshot *const valve = present();
  const eye from = present_eye(valve);
  char title[256], path[1024];
  int save = option.frames != NULL && now.time >= frames * option.every;
  sight what = {0};
  mvs_view nodes;
  what.strain = strain;
  what.chord = chosen;
  what.tool.struct_size = sizeof what.tool;
  if (hand.tool) mvs_get_tool(sim, hand.tool, &what.tool);
  memcpy(what.hand, hand.position, sizeof what.hand);
  memcpy(what.force, hand.force, sizeof what.force);
  must(mvs_snapshot_get_array(valve, MVS_ARRAY_NODE_POSITION, &nodes));
  if (hand.near_node < nodes.count) what.marked = (const double *)nodes.data + 3 * hand.near_node;
  orifice_look(valve, !window);
  what.orifice = orifice_last();
  scene_build(&triangles, valve, &from, &what);
  write_title(title, sizeof title, mode, motors, &hand, &now);
  snprintf(path, sizeof path, "%s/frame_%04d.ppm", option.frames ? option.frames : "", frames);
  if (!(window ? window_show(&triangles, &from, title, save ? path : NULL)
               : picture_paint(&triangles, &from, path))) {
    fprintf(stderr, "phantom: %s cannot be written: does the folder exist?\n", path);
    exit(1);
  }
  frames += save;
  mvs_snapshot_release(what.orifice.valve);
  mvs_snapshot_release(valve);
}

static void open_valve(void) {
  const mvs_parametric_desc founding = {.struct_size = sizeof founding,
                                        .shape = MVS_SHAPE_FOUNDING};
  const mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  const mvs_step_options step = {.struct_size = sizeof step, .dt = option.dt};
  must(mvs_create(NULL, &sim));
  must(option.valve ? mvs_load_file(sim, option.valve, MVS_FORMAT_AUTO)
                    : mvs_generate_valve(sim, &founding));
  must(mvs_set_load(sim, &systole));
  must(mvs_settle(sim, NULL, NULL));
  must(mvs_prepare_step(sim, &step));
}

static void log_driver(void *user, mvs_log_level level, const char *text) {
  (void)user;
  (void)level;
  fprintf(stderr, "%s: %s\n", option.driver, text);
}

static void map_to_valve(void) {
  const mvs_snapshot *const valve = present();
  const mvs_device_view map = map_of_surgeon(valve, option.scale);
  mvs_snapshot_release(valve);
  must(mvs_device_set_view(device, &map));
}

/* Opens the window; without one, only the driver mouse cannot continue, unless an option names the
 * pointer of another program. */
static void open_window(void) {
  const int own_pointer =
      strcmp(option.driver, "mouse") == 0 && !strstr(option.driver_options, "pointer=");
  const char *reason;
  if (option.headless) return;
  reason = window_open(800, 600);
  window = reason == NULL;
  if (reason) {
    fprintf(stderr, "phantom: no window (%s): %s\n", reason,
            own_pointer ? "the driver mouse needs it; give another --driver, --help lists them"
                        : "--seconds or Ctrl-C ends the program");
    if (own_pointer) exit(1);
  }
  if (window) help();
  if (own_pointer) add_driver_option("pointer=", mouse_open());
}

static void open_device(void) {
  mvs_device_desc desc = {.struct_size = sizeof desc,
                          .clock = option.headless ? MVS_CLOCK_VIRTUAL : MVS_CLOCK_REAL,
                          .driver = option.driver,
                          .device = option.device,
                          .options = option.driver_options,
                          .log = log_driver};
  mvs_device_info info = {.struct_size = sizeof info};
  must(mvs_device_open(&desc, &device));
  mouse_opened();
  must(mvs_device_get_info(device, &info));
  motors = info.freedoms_out > 0;
  log_device(&info);
  map_to_valve();
  must(mvs_device_start(device));
}

/* True if the tissue clock is behind the device clock; on a slow machine it skips time. */
static int tissue_is_behind(void) {
  if (option.headless) return 1;
  if (tissue_time < now.time - 0.05) tissue_time = now.time - 0.05;
  return tissue_time < now.time;
}

/* True if a device on a virtual clock has stopped: the recording ended, or the device is lost. */
static int is_over(void) {
  static uint64_t ticks;
  static double still;
  still = now.ticks == ticks ? still + option.dt : 0;
  ticks = now.ticks;
  return option.headless && still > 0.05;
}

static void turn_once(void) {
  const mvs_step_options step = {.struct_size = sizeof step, .dt = option.dt};
  int key;
  if (option.headless) must(mvs_device_advance(device, option.dt));
  must(mvs_device_sync(device, sim, &hand));
  must(mvs_device_get_state(device, &now));
  take_events();
  press_due_keys();
  while (window && (key = window_key()) != 0) press(key);
  follow_pointer();
  if (tissue_is_behind()) {
    must(mvs_step(sim, &step));
    tissue_time += option.dt;
  }
  if (window ? now.time >= frame_time : option.frames && now.time >= frames * option.every) {
    frame_time = now.time + 0.03;
    show();
  }
  if (window) window_wait(tissue_time < now.time ? 0 : 1e-3);
  if (is_over() || (window && window_wants_to_close())) ended = 1;
  if (option.seconds > 0 && now.time >= option.seconds) ended = 1;
}

static void print_summary(double before) {
  const mvs_snapshot *const valve = present();
  uint64_t hash[2];
  must(mvs_snapshot_get_hash(valve, hash));
  mvs_snapshot_release(valve);
  printf("peak force %.2f N, orifice %.1f mm2 before, %.1f after, %d frames, hash %016llx%016llx\n",
         strongest, before, 1e6 * orifice_now(sim, 1), frames, (unsigned long long)hash[0],
         (unsigned long long)hash[1]);
}

int main(int argc, char **argv) {
  double before;
  read_options(argc, argv);
  must(mvs_device_handle_signals(1));
  atexit(close_device);
  open_valve();
  before = 1e6 * orifice_now(sim, 1);
  open_window();
  open_device();
  set_mode(MVS_HAND_MODE_GRASP, 0);
  while (!ended) turn_once();
  close_device();
  print_summary(before);
  if (window) window_close();
  orifice_close();
  mvs_destroy(sim);
  return 0;
}
