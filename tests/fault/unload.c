/* A host loads libmvs with dlopen and unloads it: all threads of a call have ended when it returns,
 * and where a driver hangs, or a signal handler is installed, the library stays loaded. */
#include <dlfcn.h>
#include <mvs/mvs.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static int failed;
#define CHECK(c) \
  ((c) ? (void)0 : (void)(++failed, fprintf(stderr, "unload.c:%d: %s\n", __LINE__, #c)))

/* The functions of the library that this host calls. */
struct library {
  void *handle;
  mvs_result (*open)(const mvs_device_desc *, mvs_device **);
  mvs_result (*start)(mvs_device *);
  void (*close)(mvs_device *);
  mvs_result (*list)(const char *, const char *, mvs_driver_found, void *);
  mvs_result (*doctor)(const char *, const char *, mvs_driver_finding, void *);
  mvs_result (*handle_signals)(uint32_t);
};

/* ISO C has no conversion from the result of dlsym to a function. */
static void find(void *handle, const char *name, void *function) {
  void *const found = dlsym(handle, name);
  memcpy(function, &found, sizeof found);
  CHECK(found);
}

static struct library load(void) {
  struct library mvs = {.handle = dlopen(MVS_LIBRARY, RTLD_NOW | RTLD_LOCAL)};
  if (!mvs.handle) {
    fprintf(stderr, "%s\n", dlerror());
    _exit(2);
  }
  find(mvs.handle, "mvs_device_open", &mvs.open);
  find(mvs.handle, "mvs_device_start", &mvs.start);
  find(mvs.handle, "mvs_device_close", &mvs.close);
  find(mvs.handle, "mvs_device_list", &mvs.list);
  find(mvs.handle, "mvs_device_doctor", &mvs.doctor);
  find(mvs.handle, "mvs_device_handle_signals", &mvs.handle_signals);
  return mvs;
}

static int is_loaded(void) {
  void *const handle = dlopen(MVS_LIBRARY, RTLD_NOW | RTLD_NOLOAD);
  if (handle) dlclose(handle);
  return handle != NULL;
}

/* Runs a test in a process of its own, which libmvs has never been loaded into. */
static int status_of(void (*test)(void)) {
  int status = -1;
  const pid_t child = fork();
  if (child == 0) {
    test();
    _exit(failed ? 1 : 0);
  }
  return waitpid(child, &status, 0) == child ? status : -1;
}

static mvs_device *opened(const struct library *mvs, mvs_device_desc desc) {
  mvs_device *device = NULL;
  desc.struct_size = sizeof desc;
  CHECK(mvs->open(&desc, &device) == MVS_OK);
  return device;
}

static void take_device(void *user, const char *name, const char *model) {
  (void)name;
  (void)model;
  ++*(int *)user;
}

static void take_finding(void *user, int32_t verdict, const char *check, const char *sentence) {
  (void)verdict;
  (void)check;
  (void)sentence;
  ++*(int *)user;
}

static void a_returned_call_has_joined_its_threads(void) {
  for (int k = 0; k < 200; ++k) {
    const struct library mvs = load();
    int rows = 0;
    if (k % 4 == 0) CHECK(mvs.list("hand", NULL, take_device, &rows) == MVS_OK && rows > 0);
    if (k % 4 == 1) CHECK(mvs.doctor("hand", NULL, take_finding, &rows) == MVS_OK && rows > 0);
    if (k % 4 >= 2) {
      const mvs_device_desc desc = {.driver = "hand",
                                    .clock = k % 4 == 2 ? MVS_CLOCK_REAL : MVS_CLOCK_VIRTUAL};
      mvs_device *const device = opened(&mvs, desc);
      CHECK(mvs.start(device) == MVS_OK);
      mvs.close(device);
    }
    dlclose(mvs.handle);
    CHECK(!is_loaded());
  }
}

static volatile sig_atomic_t closed, messages, late_messages;

static void take_message(void *user, mvs_log_level level, const char *text) {
  (void)user;
  (void)level;
  (void)text;
  ++messages;
  if (closed) ++late_messages;
}

/* The driver returns from close() a second after mvs_device_close has given up. */
static void a_driver_that_closes_late_runs_on_and_calls_no_host(void) {
  const struct library mvs = load();
  const mvs_device_desc desc = {
      .driver = MVS_LIARS_DIR "/closes_late.so", .clock = MVS_CLOCK_VIRTUAL, .log = take_message};
  mvs.close(opened(&mvs, desc));
  closed = 1;
  dlclose(mvs.handle);
  CHECK(is_loaded());
  const struct timespec two = {2, 0};
  nanosleep(&two, NULL);
  CHECK(messages == 1 && late_messages == 0);
}

static void an_installed_signal_handler_keeps_the_library(void) {
  const struct library mvs = load();
  CHECK(mvs.handle_signals(1) == MVS_OK);
  dlclose(mvs.handle);
  CHECK(is_loaded());
  if (!failed) raise(SIGTERM);
}

static void a_removed_signal_handler_does_not(void) {
  const struct library mvs = load();
  CHECK(mvs.handle_signals(1) == MVS_OK);
  CHECK(mvs.handle_signals(0) == MVS_OK);
  dlclose(mvs.handle);
  CHECK(!is_loaded());
}

int main(void) {
  CHECK(status_of(a_returned_call_has_joined_its_threads) == 0);
  CHECK(status_of(a_driver_that_closes_late_runs_on_and_calls_no_host) == 0);
  const int status = status_of(an_installed_signal_handler_keeps_the_library);
  CHECK(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
  CHECK(status_of(a_removed_signal_handler_does_not) == 0);
  printf("unload: %s\n", failed ? "FAILED" : "ok");
  return failed != 0;
}
