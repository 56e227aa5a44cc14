/* Closes a parametric valve several times: CPU seconds of each closure and of 200 live steps, and
 * the hash of the closed valve. bench.mjs runs it beside the same calls in WebAssembly. closure
 * SHAPE VERTICES RUNS */
#include <inttypes.h>
#include <mvs/mvs.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static void check(mvs_result result) {
  if (result == MVS_OK) return;
  fprintf(stderr, "closure: %s\n", mvs_last_error()->message);
  exit(1);
}

static double cpu(void) {
  return (double)clock() / CLOCKS_PER_SEC;
}

int main(int argc, char **argv) {
  mvs_parametric_desc desc = {sizeof desc};
  const mvs_load_case load = {sizeof load, 0, MVS_SYSTOLE_PA, 1};
  const mvs_snapshot *open, *closed;
  uint64_t hash[2];
  mvs_sim *sim;
  int run, step;
  if (argc != 4) return 2;
  desc.shape = (mvs_shape)atoi(argv[1]);
  desc.vertices = (uint32_t)atoi(argv[2]);
  check(mvs_create(NULL, &sim));
  check(mvs_generate_valve(sim, &desc));
  check(mvs_set_load(sim, &load));
  check(mvs_get_snapshot(sim, &open));
  for (run = 0; run < atoi(argv[3]); ++run) {
    double before, settled;
    check(mvs_restore(sim, open));
    before = cpu();
    check(mvs_settle(sim, NULL, NULL));
    settled = cpu();
    check(mvs_get_snapshot(sim, &closed));
    check(mvs_snapshot_get_hash(closed, hash));
    mvs_snapshot_release(closed);
    check(mvs_restore(sim, open));
    check(mvs_step(sim, NULL));
    printf("%.6f ", settled - before);
    before = cpu();
    for (step = 0; step < 200; ++step) check(mvs_step(sim, NULL));
    printf("%.6f %016" PRIx64 "%016" PRIx64 "\n", cpu() - before, hash[0], hash[1]);
  }
  mvs_snapshot_release(open);
  mvs_destroy(sim);
  return 0;
}
