/* Messages about events, and the title of the window. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "phantom.h"

void log_line(double time, const char *format, ...) {
  va_list arguments;
  printf("%7.3f s  ", time);
  va_start(arguments, format);
  vprintf(format, arguments);
  va_end(arguments);
  printf("\n");
  fflush(stdout);
}

void log_device(const mvs_device_info *info) {
  printf("%s: %s, ", info->driver, info->model);
  if (info->freedoms_out > 0)
    printf("%.1f N peak, %.2f N continuous\n", info->peak_force, info->continuous_force);
  else
    printf("no force\n");
}

double orifice_now(mvs_sim *sim, int wait) {
  const mvs_snapshot *valve;
  must(mvs_get_snapshot(sim, &valve));
  orifice_look(valve, wait);
  mvs_snapshot_release(valve);
  return orifice_area();
}

/* The scallop of a node. */
static const char *scallop_of(mvs_sim *sim, uint32_t node, mvs_part *part) {
  const mvs_snapshot *valve;
  mvs_view triangles, scallops;
  const uint32_t *nodes, *scallop;
  uint64_t i;
  must(mvs_get_snapshot(sim, &valve));
  must(mvs_snapshot_get_array(valve, MVS_ARRAY_TRIANGLE_NODES, &triangles));
  must(mvs_snapshot_get_array(valve, MVS_ARRAY_TRIANGLE_SCALLOP, &scallops));
  nodes = triangles.data;
  scallop = scallops.data;
  strcpy(part->name, "no leaflet");
  for (i = 0; i < 3 * triangles.count && nodes[i] != node; ++i) continue;
  if (i < 3 * triangles.count) {
    must(mvs_snapshot_get_part(valve, MVS_PART_SCALLOP, scallop[i / 3], part));
  }
  mvs_snapshot_release(valve);
  return part->name;
}

const char *chord_name(mvs_sim *sim, mvs_id id, mvs_part *part) {
  const mvs_snapshot *valve;
  uint32_t count, i;
  must(mvs_get_snapshot(sim, &valve));
  must(mvs_snapshot_get_part_count(valve, MVS_PART_CHORD, &count));
  for (i = 0, part->id = 0; i < count && part->id != id; ++i) {
    must(mvs_snapshot_get_part(valve, MVS_PART_CHORD, i, part));
  }
  mvs_snapshot_release(valve);
  if (part->id != id || id == 0) strcpy(part->name, "none");
  return part->name;
}

double length_of(const double v[3]) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static const char *cause_name(uint32_t cause) {
  static const char *const names[] = {"",
                                      "the button of the device",
                                      "its speed",
                                      "the watchdog",
                                      "a program",
                                      "disconnected",
                                      "not held",
                                      "non-finite numbers",
                                      "temperature",
                                      "calibration"};
  return cause < sizeof names / sizeof names[0] ? names[cause] : "unknown cause";
}

/* The largest distance of the held tissue from its place when it was grasped, m. */
static double moved(mvs_sim *sim, const mvs_device_report *hand) {
  static double from[3], farthest;
  mvs_tool_state tool = {0};
  double way[3];
  int k;
  tool.struct_size = sizeof tool;
  if (hand->tool == 0 || mvs_get_tool(sim, hand->tool, &tool) != MVS_OK) return farthest;
  if (hand->events & MVS_EVENT_GRASPED) {
    memcpy(from, tool.proxy, sizeof from);
    farthest = 0;
  }
  for (k = 0; k < 3; ++k) way[k] = tool.proxy[k] - from[k];
  farthest = fmax(farthest, length_of(way));
  return farthest;
}

void log_events(mvs_sim *sim, const mvs_device_report *hand, const mvs_device_state *now) {
  static double peak; /* N, since the last release */
  const double far = moved(sim, hand);
  const uint32_t e = hand->events;
  mvs_part part = {0};
  if (e & MVS_EVENT_CHOSEN) {
    log_line(now->time, "selects chord %s, feels %.2f N", chord_name(sim, hand->chord, &part),
             length_of(hand->force));
  }
  if (e & MVS_EVENT_GRASPED) {
    log_line(now->time, "grasps node %u of %s; orifice %.1f mm2", (unsigned)hand->node,
             scallop_of(sim, hand->node, &part), 1e6 * orifice_now(sim, option.headless));
  }
  if (e & MVS_EVENT_MISSED) {
    log_line(now->time, "no node within reach%s",
             mouse_is_open() ? ": the wheel or the right button moves the hand to the tissue" : "");
  }
  if (e & MVS_EVENT_LET_GO) {
    log_line(now->time, "releases it; %.2f N at most, moved %.1f mm, orifice %.1f mm2", peak,
             1e3 * far, 1e6 * orifice_now(sim, option.headless));
    peak = 0;
  }
  if (e & MVS_EVENT_LOST_TOOL) log_line(now->time, "the operation removed the instrument");
  if (e & MVS_EVENT_LATCHED) {
    log_line(now->time, "forces are off (%s): key a arms again", cause_name(now->cause));
  }
  peak = fmax(peak, length_of(hand->force));
}

const char *mode_name(uint32_t mode) {
  static const char *const names[] = {
      "looks",         "grasps",        "pushes with a ball",       "pushes with a rod",
      "feels a chord", "drags a chord", "pushes with an instrument"};
  return mode < 7 ? names[mode] : "";
}

/* Forces of the motors, or without motors the use of the pointer. */
static void write_forces(char *text, size_t size, const mvs_device_state *now) {
  static const char *const phases[] = {
      "stopped",    "off (a: on)", "waiting for the hand to move away",
      "ramping up", "on",          "faded, the valve does not step",
      "off: "};
  snprintf(text, size, "felt %.2f N | forces %s%s", length_of(now->force),
           now->phase < 7 ? phases[now->phase] : "",
           now->phase == MVS_DEVICE_PHASE_LATCHED ? cause_name(now->cause) : "");
}

void write_title(char *text, size_t size, uint32_t mode, int motors, const mvs_device_report *hand,
                 const mvs_device_state *now) {
  const orifice hole = orifice_last();
  char forces[128] = "left: grasp, wheel: depth, right: to the tissue";
  mvs_snapshot_release(hole.valve);
  if (motors) write_forces(forces, sizeof forces, now);
  snprintf(text, size, "%s | orifice %.1f mm2%s | %.2f N | %s", mode_name(mode), 1e6 * hole.area,
           !hole.under_load ? " without load"
           : hole.at_rest   ? ""
                            : ", moving",
           length_of(hand->force), motors || mouse_is_open() ? forces : "no motors");
}
