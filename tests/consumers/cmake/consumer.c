/* An application in C: its header and the library that it loads have the same version. */
#include <mvs/mvs.h>
#include <stdio.h>

int main(void) {
  const uint32_t header = 10000 * MVS_VERSION_MAJOR + 100 * MVS_VERSION_MINOR + MVS_VERSION_PATCH;
  mvs_sim *sim = NULL;
  if (mvs_version() != header) {
    fprintf(stderr, "header %u, library %u\n", (unsigned)header, (unsigned)mvs_version());
    return 1;
  }
  if (mvs_create(NULL, &sim) != MVS_OK || mvs_generate_valve(sim, NULL) != MVS_OK) {
    fprintf(stderr, "%s\n", mvs_last_error()->message);
    return 1;
  }
  mvs_destroy(sim);
  return 0;
}
