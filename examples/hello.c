/* Does a valve leak? Build: cc -std=c99 hello.c -o hello $(pkg-config --cflags --libs mvs) */
#include <mvs/mvs.h>
#include <stdio.h>

int main(int argc, char **argv) {
  mvs_sim *sim = NULL;
  const mvs_snapshot *valve = NULL;
  mvs_load_case systole = {sizeof systole, 0, MVS_SYSTOLE_PA, 1};
  mvs_measures m = {.struct_size = sizeof m};
  int ok = mvs_create(NULL, &sim) == MVS_OK &&
           (argc > 1 ? mvs_load_file(sim, argv[1], MVS_FORMAT_AUTO)
                     : mvs_generate_valve(sim, NULL)) == MVS_OK &&
           mvs_set_load(sim, &systole) == MVS_OK && mvs_settle(sim, NULL, NULL) == MVS_OK &&
           mvs_get_snapshot(sim, &valve) == MVS_OK && mvs_snapshot_measure(valve, &m) == MVS_OK;
  double hole = m.regurgitant_orifice_area * 1e6;
  if (ok) printf("%s: leaks through %.1f mm2\n", m.at_rest ? "At rest" : "NOT at rest", hole);
  if (!ok) fprintf(stderr, "%s\n", mvs_last_error()->message);
  mvs_snapshot_release(valve);
  mvs_destroy(sim);
  return ok ? 0 : 1;
}
