/* Closes one valve from a file and prints its cost and its results, for tests/bench/beside,
 * which compiles it against two versions of the library.
 *
 * Usage: beside_closing VALVE LAW RESIDUAL PRESSURE POSITIONS
 *        beside_closing --generate SHAPE VERTICES POSITIONS: prints the CPU seconds of a generation
 *   LAW        number of a leaflet law, or 0 to keep that of the file
 *   RESIDUAL   N
 *   PRESSURE   Pa
 *   POSITIONS  file that receives the node positions, doubles
 *   SHAPE      number of a shape of parametric valves */
#include <mvs/experimental.h>
#include <mvs/mvs.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static void must(mvs_result code) {
  if (code == MVS_OK) return;
  fprintf(stderr, "beside_closing: %s\n", mvs_last_error()->message);
  exit(1);
}

static double cpu_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int write_positions(mvs_sim *sim, const char *file) {
  const mvs_snapshot *snapshot = NULL;
  mvs_view x;
  must(mvs_get_snapshot(sim, &snapshot));
  must(mvs_snapshot_get_array(snapshot, MVS_ARRAY_NODE_POSITION, &x));
  FILE *out = fopen(file, "wb");
  const int failed = !out || fwrite(x.data, x.stride, x.count, out) != x.count || fclose(out) != 0;
  mvs_snapshot_release(snapshot);
  return failed;
}

static int generate(char **given) {
  mvs_sim *sim = NULL;
  must(mvs_create(NULL, &sim));
  const mvs_parametric_desc desc = {.struct_size = sizeof desc,
                                    .shape = (mvs_shape)atoi(given[2]),
                                    .vertices = (uint32_t)atoi(given[3])};
  const double start = cpu_seconds();
  must(mvs_generate_valve(sim, &desc));
  printf("%.6f\n", cpu_seconds() - start);
  const int failed = write_positions(sim, given[4]);
  mvs_destroy(sim);
  return failed;
}

int main(int count, char **given) {
  if (count == 5 && strcmp(given[1], "--generate") == 0) return generate(given);
  if (count != 6) return 2;
  mvs_sim *sim = NULL;
  const mvs_snapshot *closed = NULL;
  must(mvs_create(NULL, &sim));
  must(mvs_load_file(sim, given[1], MVS_FORMAT_AUTO));
  const mvs_leaflet_desc leaflet = {.law = (mvs_leaflet_law)atoi(given[2])};
  for (uint32_t k = 0; leaflet.law > 0 && k < 2; ++k) must(mvs_set_leaflet(sim, k, &leaflet));
  const mvs_load_case load = {sizeof load, 0, atof(given[4]), 1};
  must(mvs_set_load(sim, &load));
  const mvs_settle_options options = {.struct_size = sizeof options, .residual = atof(given[3])};
  mvs_stats stats = {.struct_size = sizeof stats};
  mvs_profile profile = {.struct_size = sizeof profile};
  const double start = cpu_seconds();
  must(mvs_settle(sim, &options, &stats));
  const double seconds = cpu_seconds() - start;
  must(mvs_get_profile(sim, &profile));
  must(mvs_get_snapshot(sim, &closed));
  mvs_measures measures = {.struct_size = sizeof measures};
  must(mvs_snapshot_measure(closed, &measures));
  if (write_positions(sim, given[5]) != 0) return 1;
  printf(
      "{\"cpu_s\": %.6f, \"converged\": %u, \"iterations\": %u, \"factorisations\": %u, "
      "\"residual_N\": %.3e, \"energy_J\": %.17g, \"crossings\": %u, \"orifice_mm2\": %.4f}\n",
      seconds, stats.converged, stats.iterations, profile.factorisations, stats.residual,
      stats.energy, measures.intersections, 1e6 * measures.regurgitant_orifice_area);
  mvs_snapshot_release(closed);
  mvs_destroy(sim);
  return 0;
}
