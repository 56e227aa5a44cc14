/* Drivers are listed, and the doctor reports what each of them needs. */
#include "tests/api/check.h"

#define TRAJECTORIES MVS_SOURCE_DIR "/haptic_drivers/replay/trajectories/"

/* The number of drivers with a name, of all with null. */
static uint32_t driver_count(const char *wanted) {
  uint32_t count = 0, found = 0;
  MUST(mvs_get_driver_count(&count));
  for (uint32_t k = 0; k < count; ++k) {
    const char *name = NULL, *path = NULL;
    MUST(mvs_get_driver(k, &name, &path));
    CHECK(name[0] != 0 && path[0] == '/');
    found += !wanted || strcmp(name, wanted) == 0;
  }
  MUST_FAIL(mvs_get_driver(count, &wanted, &wanted), MVS_E_ARGUMENT, "drivers");
  return found;
}

static void count_device(void *user, const char *name, const char *model) {
  CHECK(name[0] != 0 && model[0] != 0);
  ++*(int *)user;
}

static void count_fault(void *user, int32_t verdict, const char *check, const char *sentence) {
  CHECK(check[0] != 0 && sentence[0] != 0);
  *(int *)user += verdict == 0;
}

static void count_finding(void *user, int32_t verdict, const char *check, const char *sentence) {
  CHECK(check[0] != 0 && sentence[0] != 0);
  *(int *)user += verdict == 1;
}

/* The verdicts of all drivers, as "driver: check". */
struct all_findings {
  int drivers, notes, phantom;
};

static void sort_finding(void *user, int32_t verdict, const char *check, const char *sentence) {
  struct all_findings *all = user;
  const char *const colon = strstr(check, ": ");
  CHECK(colon && sentence[0] != 0);
  all->drivers += colon && strcmp(colon, ": driver") == 0;
  all->notes += verdict == 2;
  if (strncmp(check, "phantom: ", 9) == 0) all->phantom = verdict;
}

/* A missing device is no failure unless the caller asked for that driver. */
static void a_vendors_library_that_is_not_here_is_a_note(void) {
  struct all_findings all = {0, 0, 3};
  int drivers = 0, good = 0;
  drivers = (int)driver_count(NULL);
  MUST(mvs_device_doctor(NULL, NULL, sort_finding, &all));
  CHECK(all.drivers == drivers);
  CHECK(all.notes > 0 && all.notes < drivers);
  /* a device may be present on this machine */
  CHECK(all.phantom == 2 || mvs_device_list("phantom", NULL, count_device, &drivers) == MVS_OK);
  MUST(mvs_device_doctor("phantom", NULL, count_fault, &good));
  CHECK(good > 0);
  CHECK(mvs_device_doctor(NULL, "file=x", count_finding, &good) == MVS_E_ARGUMENT);
}

static void drivers_are_listed_and_looked_at(void) {
  int replays = 0, good = 0;
  replays = (int)driver_count("replay");
  CHECK(replays == 1);
  MUST(mvs_device_doctor("replay", "file=" TRAJECTORIES "circle.txt", count_finding, &good));
  CHECK(good > 1);
  CHECK(mvs_device_doctor("nowhere", NULL, count_finding, &good) == MVS_E_IO);
}

/* An embedding program has neither the command nor the sources. */
static void remedies_are_those_of_the_interface(void) {
  int found = 0;
  MUST_FAIL(mvs_device_list("nowhere", NULL, count_device, &found), MVS_E_IO, "mvs_get_driver");
  CHECK(!strstr(mvs_last_error()->message, "mvs haptics"));
  MUST_FAIL(mvs_device_list("mouse", NULL, count_device, &found), MVS_E_DEVICE, "shared memory");
  CHECK(!strstr(mvs_last_error()->message, "README"));
}

int main(void) {
  drivers_are_listed_and_looked_at();
  remedies_are_those_of_the_interface();
  a_vendors_library_that_is_not_here_is_a_note();
  return finish("driver_list");
}
