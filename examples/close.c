/* Closes the valve of a file under 120 mmHg, prints the result, and writes it for ParaView.
 * Build: cc -std=c99 close.c -o close $(pkg-config --cflags --libs mvs)
 * Use:   ./close valve.obj closed.vtp */
#include <mvs/mvs.h>
#include <stdio.h>
#include <stdlib.h>

/* Every fallible call returns a code; mvs_last_error() has its sentence. */
static void must(mvs_result result) {
  const mvs_error *error = mvs_last_error();
  if (result == MVS_OK) return;
  fprintf(stderr, "%s: %s\n", mvs_result_name(result), error->message);
  exit(1);
}

static int32_t show_progress(void *user, double share, double residual) {
  (void)user;
  fprintf(stderr, "\r%3.0f %%  %.1e N", 100 * share, residual);
  return 0; /* any other value cancels */
}

static mvs_sim *open_valve(const char *path) {
  mvs_sim_desc desc = {0};
  mvs_sim *sim = NULL;
  desc.struct_size = sizeof desc;
  desc.progress = show_progress;
  must(mvs_create(&desc, &sim));
  must(mvs_load_file(sim, path, MVS_FORMAT_AUTO));
  return sim;
}

static void close_valve(mvs_sim *sim) {
  mvs_load_case systole = {0};
  mvs_settle_options options = {0};
  mvs_stats stats = {0};
  systole.struct_size = sizeof systole;
  systole.pressure = MVS_SYSTOLE_PA;
  systole.boundary_fraction = 1; /* annulus and papillary heads at their systolic positions */
  must(mvs_set_load(sim, &systole));

  options.struct_size = sizeof options;
  options.residual = 1e-4;
  stats.struct_size = sizeof stats;
  must(mvs_settle(sim, &options, &stats));
  fprintf(stderr, "\n");
  printf("%s after %u iterations and %.2f s\n", stats.converged ? "closed" : "NOT at rest",
         (unsigned)stats.iterations, stats.wall_s);
}

/* A snapshot gives access to every array of the valve without a copy. */
static void print_tightest_chord(const mvs_snapshot *valve) {
  mvs_view tension;
  mvs_part chord;
  uint32_t tightest = 0;
  uint64_t i;
  const double *newton;
  must(mvs_snapshot_get_array(valve, MVS_ARRAY_CHORD_TENSION, &tension));
  newton = tension.data;
  for (i = 1; i < tension.count; ++i) {
    if (newton[i] > newton[tightest]) tightest = (uint32_t)i;
  }
  must(mvs_snapshot_get_part(valve, MVS_PART_CHORD, tightest, &chord));
  printf("tightest chord: %s, %.2f N\n", chord.name, newton[tightest]);
}

static void print_measures(const mvs_snapshot *valve) {
  mvs_measures m = {0};
  m.struct_size = sizeof m;
  must(mvs_snapshot_measure(valve, &m));
  printf("regurgitant orifice: %.1f mm2\n", m.regurgitant_orifice_area * 1e6);
  printf("coaptation length: %.1f mm on average\n", m.coaptation_length_mean * 1e3);
}

int main(int argc, char **argv) {
  mvs_sim *sim;
  const mvs_snapshot *valve = NULL;
  if (argc != 3) {
    fprintf(stderr, "use: %s valve.obj closed.vtp\n", argv[0]);
    return 2;
  }
  sim = open_valve(argv[1]);
  close_valve(sim);
  must(mvs_get_snapshot(sim, &valve));
  mvs_destroy(sim); /* a snapshot outlives its simulator */
  print_measures(valve);
  print_tightest_chord(valve);
  must(mvs_save_file(valve, argv[2], MVS_FORMAT_AUTO));
  mvs_snapshot_release(valve);
  return 0;
}
