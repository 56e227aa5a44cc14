// Cost of the measures of a closed valve: all that mvs_snapshot_measure returns, the same and the
// measures of regions, and each group alone.
//
//   bench_measure                    S and M, closed, leaking and open
//   bench_measure --scenes S --states closed --repeat 1
//   bench_measure --shapes 50        also 50 random shapes of each, of which it prints the digest
//   bench_measure --csv FILE
//
// Every run begins with a new snapshot, so that no run finds what another has computed. Columns:
// CPU time in ms, the fastest of the runs, since other work on the machine only ever adds. A group
// includes the parts of other groups that it needs. The digest covers the bits of all figures and
// of the arrays behind them: two builds that print the same one measure the same.
#include <mvs/sim.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "anatomy/parametric.h"
#include "geometry/intersect.h"
#include "session/snapshot.h"
#include "solve/static/mesh_hierarchy.h"
#include "tests/bench/closing.h"
#include "tests/bench/table.h"

using namespace mvs::core;

namespace {

struct Options {
  std::vector<std::string> scenes = {"S", "M"}, states = {"closed", "leaking", "open"};
  int repeat = 20, shapes = 0;
  std::string csv;
};

struct Shape {
  std::string scene, name;
  ModelState state;
};

// FNV-1a, 64 bits, over the bits of figures and arrays.
class Digest {
 public:
  template <typename Item>
  void add(const std::vector<Item> &items) {
    add(items.data(), items.size() * sizeof(Item));
  }
  void add(const void *data, size_t size) {
    const auto *bytes = static_cast<const unsigned char *>(data);
    for (size_t k = 0; k < size; ++k) hash_ = (hash_ ^ bytes[k]) * 0x100000001b3;
  }
  void add(const mvs_snapshot &s) {
    add(&s.measures(), sizeof(mvs_measures));
    add(s.orifice().vertices);
    add(s.orifice().triangles);
    add(s.coaptation().distance);
    add(s.coaptation().share);
    for (const CoaptationStation &station : s.coaptation().line) {
      add(station.point.data(), sizeof station.point);
      add(&station.length, sizeof station.length);
    }
    add(s.strain().stretch);
    add(s.strain().stress);
    add(s.regions());
  }
  std::string text() const {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash_));
    return digits;
  }

 private:
  uint64_t hash_ = 0xcbf29ce484222325;
};

SnapshotPtr fresh(const ModelState &state) {
  return make_snapshot({state, {}});
}

ModelState close(const std::string &scene, double annulus_scale) {
  mvs_parametric_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.vertices = bench::scene_vertices.at(scene);
  desc.annulus_scale = annulus_scale;
  const ModelPtr model = make_model(make_parametric_valve(desc));
  State state = initial_state(*model);
  state.load = {MVS_SYSTOLE_PA, 1};
  Solver solver(Backend::fastest);
  settle_with_mesh_hierarchy(solver, *model, state, {}, {});
  return {model, state};
}

Shape shape_of(const std::string &scene, const std::string &state) {
  ModelState valve = close(scene, state == "leaking" ? 1.4 : 1.0);
  if (state == "open") valve.state = initial_state(*valve.model);
  return {scene, state, valve};
}

// Moves the nodes by smooth waves of up to 2 mm, another set of them for each `number`.
ModelState wavy(const ModelState &from, int number) {
  ModelState moved = from;
  std::vector<Vec3> x = from.state.x;
  const double size = 2e-3 * (1 + number % 7) / 7, n = number;
  for (Vec3 &p : x) {
    const Vec3 q = 300 * p;
    p += size * Vec3(std::sin(q[1] + 1.3 * n), std::sin(q[2] + 2.1 * n), std::sin(q[0] + 0.7 * n));
  }
  moved.state.x = x;
  return moved;
}

// The fastest run of one group on new snapshots, ms.
template <typename Group>
double time_of(const Options &options, const ModelState &state, Group &&group) {
  double best = HUGE_VAL;
  for (int k = 0; k < options.repeat; ++k) {
    const SnapshotPtr snapshot = fresh(state);
    best = std::min(best, bench::timed([&] { group(*snapshot.get()); }).cpu);
  }
  return 1e3 * best;
}

void add_row(const Options &options, const Shape &shape, bench::Table &table) {
  const auto time = [&](auto &&group) { return time_of(options, shape.state, group); };
  const double all = time([](const mvs_snapshot &s) { s.measures(); });
  const double regions = time([](const mvs_snapshot &s) { s.measures(), s.regions(); });
  const double orifice = time([](const mvs_snapshot &s) { s.orifice(); });
  const double coaptation = time([](const mvs_snapshot &s) { s.coaptation(); });
  const double tenting =
      time([](const mvs_snapshot &s) { measure_tenting_billow(*s.model, s.state.x); });
  const double annulus = time([](const mvs_snapshot &s) { measure_annulus(*s.model, s.state.x); });
  const double crossings =
      time([](const mvs_snapshot &s) { find_intersections(s.state.x, s.model->valve.triangles); });
  const double strain = time([](const mvs_snapshot &s) { s.strain(), s.chords(); });
  Digest digest;
  digest.add(*fresh(shape.state).get());
  for (int k = 0; k < options.shapes; ++k) digest.add(*fresh(wavy(shape.state, k)).get());
  table.row({shape.scene, shape.name, all, regions, orifice, coaptation, tenting, annulus,
             crossings, strain, 1e6 * fresh(shape.state)->measures().regurgitant_orifice_area,
             digest.text()});
}

int run(int argc, char **argv) {
  Options options;
  CLI::App app("Times the measures of a valve, together and group by group.", "bench_measure");
  app.add_option("--scenes", options.scenes, "S 425, M 1700, L 6800 vertices")
      ->capture_default_str()
      ->check(CLI::IsMember(bench::keys(bench::scene_vertices)));
  app.add_option("--states", options.states, "closed, leaking, open")
      ->capture_default_str()
      ->check(CLI::IsMember({"closed", "leaking", "open"}));
  app.add_option("--repeat", options.repeat, "runs of each")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--shapes", options.shapes, "random shapes in the digest");
  app.add_option("--csv", options.csv, "file to write the table to");
  CLI11_PARSE(app, argc, argv);
  bench::Table table({"scene ", "shape ", "all ms", "and regions", "orifice", "coaptation",
                      "tenting", "annulus", "crossings", "strain", "leak mm2", "digest "},
                     options.csv);
  for (const std::string &scene : options.scenes) {
    for (const std::string &state : options.states) {
      add_row(options, shape_of(scene, state), table);
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_measure: %s\n", error.what());
    return 1;
  }
}
