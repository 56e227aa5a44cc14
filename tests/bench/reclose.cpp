// What closing again costs after one surgical operation, beside closing the same valve from open.
//
//   bench_reclose                    scenes S, M and two sick valves; every operation on each
//   bench_reclose --scenes S --repeat 1
//
// A valve is closed, then operated on. The changed valve is closed twice: from open, and from where
// the valve was. Columns: iterations and wall time (the median of the runs) of both, their ratio,
// and how far apart the two closed shapes are. The last line is the median over all operations.
//
// Exit code 1: a valve did not come to rest, or meets itself.
#include <mvs/sim.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "anatomy/parametric.h"
#include "base/error.h"
#include "base/intersect.h"
#include "physics/solver.h"

using namespace mvs;

namespace {

struct Scene {
  uint32_t vertices;
  double annulus_scale;
  bool long_strut;
};
const std::map<std::string, Scene> scenes = {{"S", {425, 1, false}},
                                             {"M", {1700, 1, false}},
                                             {"L", {6800, 1, false}},
                                             {"sickS", {425, 1.15, true}},
                                             {"sickM", {1700, 1.15, true}}};

struct Operation {
  std::string name;
  std::function<void(Valve &, const State &closed)> apply;
};

struct Options {
  std::vector<std::string> scenes = {"S", "sickS", "M", "sickM"};
  int repeat = 3;
};

struct Run {
  SolveStats stats;
  State state;
  std::vector<double> wall_s;
  double median_s() const { return wall_s[wall_s.size() / 2]; }
};

Valve make_scene(const Scene &scene) {
  mvs_parametric_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.vertices = scene.vertices;
  desc.annulus_scale = scene.annulus_scale;
  Valve valve = make_parametric_valve(desc);
  for (Chord &c : valve.chords) {
    if (scene.long_strut && c.name == "A2/7") c.rest_length *= 1.25;
  }
  return valve;
}

size_t chord_named(const Valve &valve, const std::string &name) {
  for (size_t c = 0; c < valve.chords.size(); ++c) {
    if (valve.chords[c].name == name) return c;
  }
  fail(MVS_E_ARGUMENT, "chord", "the valve has no chord %s", name.c_str());
}

Operation chord_length(const std::string &name, double factor) {
  return {"length " + name + " " + std::to_string(factor).substr(0, 4),
          [=](Valve &v, const State &) { v.chords[chord_named(v, name)].rest_length *= factor; }};
}

Operation remove_chord(const std::string &name) {
  return {"remove " + name, [=](Valve &v, const State &) {
            v.chords.erase(v.chords.begin() + static_cast<long>(chord_named(v, name)));
          }};
}

// A neochord beside another: from its head to the vertex nearest to its insertion that has none,
// tight by a tenth in the closed valve.
Operation add_chord(const std::string &beside) {
  return {"add beside " + beside, [=](Valve &v, const State &closed) {
            const Chord &old = v.chords[chord_named(v, beside)];
            std::vector<uint8_t> taken(v.rest.size(), 1);
            for (const Tri &t : v.triangles) {
              for (const uint32_t i : t) taken[i] = 0;
            }
            for (const Chord &c : v.chords) taken[c.b] = 1;
            for (const uint32_t i : v.annulus) taken[i] = 1;
            uint32_t best = none;
            for (uint32_t i = 0; i < v.rest.size(); ++i) {
              if (taken[i]) continue;
              const auto away = [&](uint32_t k) { return (v.rest[k] - v.rest[old.b]).norm(); };
              if (best == none || away(i) < away(best)) best = i;
            }
            Chord chord = old;
            chord.id = 0;
            chord.name = "neochord";
            chord.b = best;
            chord.rest_length = 0.9 * (closed.x[chord.a] - closed.x[best]).norm();
            v.chords.push_back(chord);
          }};
}

// The annulus under load about its centroid; x runs from commissure to commissure.
Operation scale_annulus(const std::string &name, const Vec3 &factor) {
  return {name, [=](Valve &v, const State &) {
            Vec3 centre = Vec3::Zero();
            for (const uint32_t i : v.annulus) centre += v.loaded[i];
            centre /= static_cast<double>(v.annulus.size());
            for (const uint32_t i : v.annulus) {
              v.loaded[i] = centre + factor.cwiseProduct(v.loaded[i] - centre);
            }
          }};
}

Operation move_head(const Vec3 &by) {
  return {"move a head", [=](Valve &v, const State &) { v.loaded[v.heads[0].node] += by; }};
}

std::vector<Operation> operations() {
  std::vector<Operation> all;
  for (const char *name : {"A2/7", "A2/2", "A1/7", "P2/2", "P2/6", "P1/3"}) {
    all.push_back(chord_length(name, 0.75));
    all.push_back(remove_chord(name));
  }
  all.push_back(chord_length("A2/7", 1.25));
  all.push_back(chord_length("P2/2", 0.90));
  for (const char *name : {"A2/2", "P2/6"}) all.push_back(add_chord(name));
  all.push_back(scale_annulus("annulus 0.97", {0.97, 0.97, 1}));
  all.push_back(scale_annulus("annulus 0.90", {0.90, 0.90, 1}));
  all.push_back(scale_annulus("annulus AP 0.85", {1, 0.85, 1}));
  all.push_back(move_head({0, 0, 2e-3}));
  return all;
}

Run close(const Options &options, const Model &model, const State &from) {
  Run run;
  for (int k = 0; k < options.repeat; ++k) {
    run.state = from;
    run.state.load = {MVS_SYSTOLE_PA, 1};
    // a new solver each time, so that no run warms up the next
    Solver solver(MVS_BACKEND_DEFAULT);
    run.stats = solver.settle(model, run.state, {}, {});
    run.wall_s.push_back(run.stats.wall_s);
  }
  std::sort(run.wall_s.begin(), run.wall_s.end());
  return run;
}

struct Row {
  double iterations, wall;  // again over open
  bool sound;               // both at rest, nothing intersects
};

double farthest(const State &a, const State &b) {
  double most = 0;
  for (size_t i = 0; i < a.x.size(); ++i) most = std::max(most, (a.x[i] - b.x[i]).norm());
  return most;
}

Row compare(const Options &options, const std::string &scene, const Valve &valve,
            const State &closed, const Operation &operation) {
  Valve changed = valve;
  operation.apply(changed, closed);
  const ModelPtr model = make_model(changed);
  const Run open = close(options, *model, initial_state(*model));
  const Run again = close(options, *model, closed);
  const bool sound = open.stats.converged && again.stats.converged &&
                     find_intersections(again.state.x, model->valve.triangles).empty();
  const Row row{static_cast<double>(again.stats.iterations) / open.stats.iterations,
                again.median_s() / open.median_s(), sound};
  std::printf("%-6s %-20s %5u %5u %6.2f  %8.4f %8.4f %6.2f  %6.2f  %s\n", scene.c_str(),
              operation.name.c_str(), open.stats.iterations, again.stats.iterations, row.iterations,
              open.median_s(), again.median_s(), row.wall, farthest(open.state, again.state) * 1e3,
              sound ? "" : "NOT AT REST");
  std::fflush(stdout);
  return row;
}

double median(std::vector<Row> rows, double Row::*of) {
  std::sort(rows.begin(), rows.end(), [=](const Row &a, const Row &b) { return a.*of < b.*of; });
  return rows[rows.size() / 2].*of;
}

int run(int argc, char **argv) {
  Options options;
  std::vector<std::string> names;
  for (const auto &scene : scenes) names.push_back(scene.first);
  CLI::App app("Times closing again after an operation beside closing from open.", "bench_reclose");
  app.add_option("--scenes", options.scenes, "S 425, M 1700, L 6800 vertices")
      ->capture_default_str()
      ->check(CLI::IsMember(names));
  app.add_option("--repeat", options.repeat, "runs of each")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);

  std::printf("%-6s %-20s %5s %5s %6s  %8s %8s %6s  %6s\n", "scene", "operation", "open", "again",
              "ratio", "open s", "again s", "ratio", "mm");
  std::vector<Row> rows;
  for (const std::string &scene : options.scenes) {
    const Valve valve = make_scene(scenes.at(scene));
    const ModelPtr model = make_model(valve);
    const Run before = close(options, *model, initial_state(*model));
    for (const Operation &operation : operations()) {
      rows.push_back(compare(options, scene, valve, before.state, operation));
    }
  }
  std::printf("median of %zu: %.2f of the iterations, %.2f of the time\n", rows.size(),
              median(rows, &Row::iterations), median(rows, &Row::wall));
  const bool sound = std::all_of(rows.begin(), rows.end(), [](const Row &r) { return r.sound; });
  return sound ? 0 : 1;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_reclose: %s\n", error.what());
    return 1;
  }
}
