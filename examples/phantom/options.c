/* Parses the command line. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "phantom.h"

options option = {NULL, NULL, NULL, "", NULL, "phantom", "", 1, 1e-3, 0.1, 0, 0};

static const char *script;

static void list_drivers(FILE *to) {
  uint32_t count = 0;
  const char *name = NULL, *path = NULL;
  if (mvs_get_driver_count(&count) != MVS_OK) return;
  for (uint32_t k = 0; k < count && mvs_get_driver(k, &name, &path) == MVS_OK; ++k) {
    fprintf(to, "  %-16s %s\n", name, path);
  }
}

static void print_use(FILE *to) {
  fprintf(to,
          "use: phantom [--driver NAME|PATH] [--device NAME] [--option KEY=VALUE ...]\n"
          "                    else the driver mouse: the pointer of the window moves the hand\n"
          "  [--valve FILE]    else the shipped valve       [--scale S]  of the motion, 1\n"
          "  [--script FILE]   recording for replay         [--keys \"2.0:u 3.0:s\"]  keys at "
          "times in s\n"
          "  [--headless]      without a window, on a virtual clock\n"
          "  [--seconds S]     else to the end of the script  [--dt S]  time step, 0.001\n"
          "  [--frames DIR]    folder of pictures           [--every S]  between them, 0.1\n"
          "  [--help]          prints this\n"
          "  [--out BASE]      files of keys s and w: BASE.obj, BASE.json\n"
          "drivers:\n");
  list_drivers(to);
}

static void use(const char *why, const char *what) {
  fprintf(stderr, "phantom: %s%s\n", why, what);
  print_use(stderr);
  exit(2);
}

static double number(const char *text) {
  char *end;
  const double value = strtod(text, &end);
  if (end == text || *end != 0) use("not a number: ", text);
  return value;
}

void add_driver_option(const char *key, const char *value) {
  const size_t used = strlen(option.driver_options), room = sizeof option.driver_options - used;
  const int wanted = snprintf(option.driver_options + used, room, "%s%s\n", key, value);
  if (wanted < 0 || (size_t)wanted >= room) use("too many options of the driver, at ", value);
}

static void read_option(const char *name, const char *value) {
  if (!strcmp(name, "--driver"))
    option.driver = value;
  else if (!strcmp(name, "--device"))
    option.device = value;
  else if (!strcmp(name, "--option"))
    add_driver_option("", value);
  else if (!strcmp(name, "--script"))
    add_driver_option("file=", script = value);
  else if (!strcmp(name, "--valve"))
    option.valve = value;
  else if (!strcmp(name, "--keys"))
    option.keys = value;
  else if (!strcmp(name, "--frames"))
    option.frames = value;
  else if (!strcmp(name, "--out"))
    option.out = value;
  else if (!strcmp(name, "--scale"))
    option.scale = number(value);
  else if (!strcmp(name, "--seconds"))
    option.seconds = number(value);
  else if (!strcmp(name, "--every"))
    option.every = number(value);
  else if (!strcmp(name, "--dt"))
    option.dt = number(value);
  else
    use("unknown option ", name);
}

const char *next_key(const char *keys, double *when, int *key) {
  char *colon;
  *when = strtod(keys, &colon);
  if (colon == keys || colon[0] != ':' || colon[1] == 0) return NULL;
  *key = (unsigned char)colon[1];
  return colon + 2;
}

/* True for a list of TIME:KEY. */
static int are_keys(const char *keys) {
  const char *rest;
  double when;
  int key;
  while ((rest = next_key(keys, &when, &key)) != NULL) keys = rest;
  return keys[strspn(keys, " ")] == 0;
}

static void must_know_keys(const char *keys) {
  double when;
  int key;
  char name[2] = {0, 0};
  while ((keys = next_key(keys, &when, &key)) != NULL) {
    name[0] = (char)key;
    if (!is_key(key)) use("--keys has an unknown key (--help lists them): ", name);
  }
}

void read_options(int argc, char **argv) {
  int i;
  for (i = 1; i < argc; ++i) {
    if (!strcmp(argv[i], "--help") || !strcmp(argv[i], "-h")) {
      print_use(stdout);
      printf("keys:\n");
      help();
      exit(0);
    } else if (!strcmp(argv[i], "--headless")) {
      option.headless = 1;
    } else if (i + 1 < argc) {
      read_option(argv[i], argv[i + 1]);
      ++i;
    } else {
      use("a value is missing after ", argv[i]);
    }
  }
  if (!option.driver) option.driver = "mouse";
  if (option.headless && !strcmp(option.driver, "mouse")) {
    use("--headless has no window, and the driver mouse needs its pointer: leave --headless away, "
        "or "
        "give --driver replay --script FILE",
        "");
  }
  if (!(option.every > 0)) use("--every must be positive", "");
  if (!are_keys(option.keys)) use("not a list of TIME:KEY: ", option.keys);
  must_know_keys(option.keys);
  if (!strcmp(option.driver, "replay") && !strstr(option.driver_options, "file=")) {
    use("the driver replay needs --script FILE, a recording", "");
  }
  if (option.headless && option.seconds <= 0) {
    if (!script) use("--headless needs --seconds or --script, which end it", "");
    add_driver_option("end=", "stop");
  }
}
