/* Threads of the library leave signals to those of the host, except for their own faults. */
#include <dirent.h>
#include <signal.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "tests/api/check.h"

/* The mask of blocked signals of a thread; 0 where the system does not report it. */
static unsigned long long blocked_of(const char *thread) {
  char path[300], line[256];
  unsigned long long mask = 0;
  snprintf(path, sizeof path, "/proc/self/task/%s/status", thread);
  FILE *const file = fopen(path, "r");
  while (file && fgets(line, sizeof line, file)) {
    static const char key[] = "SigBlk:";
    if (strncmp(line, key, sizeof key - 1) == 0) mask = strtoull(line + sizeof key - 1, NULL, 16);
  }
  if (file) fclose(file);
  return mask;
}

static int has(unsigned long long mask, int signal) {
  return (int)(mask >> (signal - 1) & 1);
}

static int has_proc(void) {
  DIR *const threads = opendir("/proc/self/task");
  if (threads) closedir(threads);
  return threads != NULL;
}

/* Whether a mask is that of the library. */
static int is_good(unsigned long long mask) {
  static const int others[] = {SIGINT, SIGTERM, SIGABRT, SIGALRM, SIGUSR1, SIGCHLD, SIGPIPE};
  static const int faults[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL};
  int good = 1;
  for (size_t k = 0; k < sizeof others / sizeof *others; ++k) good = good && has(mask, others[k]);
  for (size_t k = 0; k < sizeof faults / sizeof *faults; ++k) good = good && !has(mask, faults[k]);
  return good;
}

/* The threads beside the first one, or the number of those with another mask. */
static int count_threads(int only_wrong) {
  int count = 0;
  DIR *const threads = opendir("/proc/self/task");
  if (!threads) return 0;
  for (struct dirent *entry; (entry = readdir(threads)) != NULL;) {
    const int is_first = strtol(entry->d_name, NULL, 10) == (long)getpid();
    if (entry->d_name[0] == '.' || is_first) continue;
    count += !only_wrong || !is_good(blocked_of(entry->d_name));
  }
  closedir(threads);
  return count;
}

/* A thread that has not begun to run blocks all signals for a moment. */
static int wrong_threads(void) {
  const struct timespec moment = {0, 10000000};
  for (int k = 0; k < 500 && count_threads(1) > 0; ++k) nanosleep(&moment, NULL);
  return count_threads(1);
}

static void threads_of_a_device_block_all_signals_but_faults(void) {
  mvs_device_desc desc = {.struct_size = sizeof desc, .driver = "hand"};
  mvs_device *device = NULL;
  MUST(mvs_device_open(&desc, &device));
  MUST(mvs_device_start(device));
  CHECK(count_threads(0) == (has_proc() ? 2 : 0));
  CHECK(wrong_threads() == 0);
  mvs_device_close(device);
}

static void workers_of_a_simulator_do_so_too(void) {
  mvs_sim_desc desc = {.struct_size = sizeof desc, .workers = 3};
  mvs_parametric_desc shape = {.struct_size = sizeof shape, .vertices = 2500};
  mvs_load_case load = {.struct_size = sizeof load, .pressure = 1000, .boundary_fraction = 1};
  mvs_settle_options few = {.struct_size = sizeof few, .max_iterations = 2};
  mvs_sim *sim = NULL;
  MUST(mvs_create(&desc, &sim));
  MUST(mvs_generate_valve(sim, &shape));
  MUST(mvs_set_load(sim, &load));
  MUST(mvs_settle(sim, &few, NULL));
  CHECK(count_threads(0) == (has_proc() ? 2 : 0));
  CHECK(wrong_threads() == 0);
  mvs_destroy(sim);
}

int main(void) {
  threads_of_a_device_block_all_signals_but_faults();
  workers_of_a_simulator_do_so_too();
  return finish("device_threads");
}
