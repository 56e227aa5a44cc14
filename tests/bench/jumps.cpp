// Jumps of the regurgitant orifice along paths of smooth deformations: where a decision of the
// method flips (another sample, another cut, the end of the relaxation), the area is not
// continuous. With --tenting those of the tenting height: where no ball rolls to the deepest place.
//
//   bench_jumps                      S and M, leaking and open, 6 paths of 40 steps of 1 um each
//   bench_jumps --scenes S --states open --paths 1 --steps 20
//   bench_jumps --tenting            sealed and leaking valves; steps of more than 1 um from the
//   median bench_jumps --csv FILE
//
// All nodes move along a smooth wave with an amplitude of 1 um a step. The rise of a smooth area is
// the same in all steps of a path, up to its curvature: a jump is the difference of a rise from the
// median of its path. Steps are sorted by what changed in them: the number of samples, the number
// of triangles of the cut, or neither (the relaxation ends elsewhere). Columns: the largest jump in
// mm2 and over the area, and the root of the mean square of all.
#include <mvs/sim.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "anatomy/parametric.h"
#include "measure/annulus/frame.h"
#include "measure/orifice/orifice.h"
#include "measure/orifice/samples.h"
#include "measure/tenting/tenting_billow.h"
#include "solve/static/mesh_hierarchy.h"
#include "tests/bench/closing.h"
#include "tests/bench/table.h"

using namespace mvs::core;

namespace {

constexpr double step_m = 1e-6;

struct Options {
  std::vector<std::string> scenes = {"S", "M"}, states = {"leaking", "open"};
  int paths = 6, steps = 40;
  bool tenting = false;
  std::string csv;
};

struct Shape {
  ModelPtr model;
  std::vector<Vec3> x;
};

Shape shape_of(const std::string &scene, const std::string &state) {
  mvs_parametric_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.vertices = bench::scene_vertices.at(scene);
  desc.annulus_scale = state == "leaking" ? 1.4 : 1.0;
  const ModelPtr model = make_model(make_parametric_valve(desc));
  State at = initial_state(*model);
  if (state != "open") {
    at.load = {MVS_SYSTOLE_PA, 1};
    Solver solver(Backend::fastest);
    settle_with_mesh_hierarchy(solver, *model, at, {}, {});
  }
  return {model, at.x};
}

// The direction of a path: a wave of 10 to 20 mm, another one for each number.
std::vector<Vec3> wave(const std::vector<Vec3> &x, int number) {
  const double n = number, k = 300 + 40 * (number % 8);
  std::vector<Vec3> moves;
  for (const Vec3 &p : x) {
    const Vec3 q = k * p;
    moves.emplace_back(std::sin(q[1] + 1.3 * n), std::sin(q[2] + 2.1 * n),
                       std::sin(q[0] + 0.7 * n));
  }
  return moves;
}

struct Place {
  double area;
  size_t samples, triangles;
};

Place measure(const Model &model, const std::vector<Vec3> &x) {
  const Frame frame = valve_frame(model, x);
  const Orifice found = cut_orifice(model, x);
  const orifice::Sheet sheet = orifice::local_sheet(x, model.valve.triangles, model, x, frame);
  return {found.area, orifice::sample(sheet).point.size(), found.triangles.size()};
}

enum Kind : size_t { samples, cut, relaxation, kinds };
constexpr std::array<const char *, kinds> kind_names = {"samples", "cut", "relaxation"};

struct Jumps {
  size_t count = 0;
  double most = 0, squares = 0;
  void add(double jump) {
    ++count;
    most = std::max(most, std::abs(jump));
    squares += jump * jump;
  }
};

void follow(const Shape &shape, int number, int steps, std::array<Jumps, kinds> &jumps) {
  const std::vector<Vec3> moves = wave(shape.x, number);
  std::vector<Place> places;
  for (int s = 0; s <= steps; ++s) {
    std::vector<Vec3> x = shape.x;
    for (size_t i = 0; i < x.size(); ++i) x[i] += s * step_m * moves[i];
    places.push_back(measure(*shape.model, x));
  }
  std::vector<double> rises;
  for (size_t s = 1; s < places.size(); ++s) rises.push_back(places[s].area - places[s - 1].area);
  const double usual = bench::median(rises);
  for (size_t s = 1; s < places.size(); ++s) {
    const Place &a = places[s - 1], &b = places[s];
    const Kind kind = a.samples != b.samples       ? samples
                      : a.triangles != b.triangles ? cut
                                                   : relaxation;
    jumps[kind].add(rises[s - 1] - usual);
  }
}

void add_rows(const Options &options, const std::string &scene, const std::string &state,
              bench::Table &table) {
  const Shape shape = shape_of(scene, state);
  const double area = measure(*shape.model, shape.x).area;
  std::array<Jumps, kinds> jumps;
  for (int p = 0; p < options.paths; ++p) follow(shape, p, options.steps, jumps);
  for (size_t k = 0; k < kinds; ++k) {
    const Jumps &j = jumps[k];
    const double mean = j.count > 0 ? std::sqrt(j.squares / static_cast<double>(j.count)) : 0;
    table.row({scene, state, kind_names[k], j.count, 1e6 * area, 1e6 * j.most, j.most / area,
               1e6 * mean});
  }
}

// Steps of a path whose rise of the tenting height is so far from the median of the path, m.
constexpr double tenting_jump = 1e-6;

void add_tenting_row(const Options &options, const std::string &scene, const std::string &state,
                     bench::Table &table) {
  const Shape shape = shape_of(scene, state);
  const auto depth = [&](const std::vector<Vec3> &x) {
    return measure_tenting_billow(*shape.model, x).tenting_height;
  };
  size_t count = 0, jumps = 0;
  double most = 0;
  for (int p = 0; p < options.paths; ++p) {
    const std::vector<Vec3> moves = wave(shape.x, p);
    std::vector<double> rises;
    double last = depth(shape.x);
    for (int s = 1; s <= options.steps; ++s) {
      std::vector<Vec3> x = shape.x;
      for (size_t i = 0; i < x.size(); ++i) x[i] += s * step_m * moves[i];
      const double next = depth(x);
      rises.push_back(next - last);
      last = next;
    }
    const double usual = bench::median(rises);
    for (const double rise : rises) {
      ++count;
      jumps += std::abs(rise - usual) > tenting_jump ? 1 : 0;
      most = std::max(most, std::abs(rise - usual));
    }
  }
  table.row({scene, state, count, 1e3 * depth(shape.x), jumps, 1e3 * most});
}

int run_tenting(const Options &options) {
  bench::Table table({"scene ", "shape   ", "steps", "tenting mm", "jumps", "most mm"},
                     options.csv);
  for (const std::string &scene : options.scenes) {
    for (const char *state : {"sealed", "leaking"}) add_tenting_row(options, scene, state, table);
  }
  return 0;
}

int run(int argc, char **argv) {
  Options options;
  CLI::App app("Jumps of the regurgitant orifice along smooth paths.", "bench_jumps");
  app.add_option("--scenes", options.scenes, "S 425, M 1700, L 6800 vertices")
      ->capture_default_str()
      ->check(CLI::IsMember(bench::keys(bench::scene_vertices)));
  app.add_option("--states", options.states, "leaking, open")
      ->capture_default_str()
      ->check(CLI::IsMember({"leaking", "open"}));
  app.add_option("--paths", options.paths, "paths of each")->check(CLI::PositiveNumber);
  app.add_option("--steps", options.steps, "steps of a path")->check(CLI::PositiveNumber);
  app.add_flag("--tenting", options.tenting, "the tenting height instead of the orifice");
  app.add_option("--csv", options.csv, "file to write the table to");
  CLI11_PARSE(app, argc, argv);
  if (options.tenting) return run_tenting(options);
  bench::Table table(
      {"scene ", "shape   ", "changed   ", "steps", "area mm2", "most mm2", "of area", "rms mm2"},
      options.csv);
  for (const std::string &scene : options.scenes) {
    for (const std::string &state : options.states) add_rows(options, scene, state, table);
  }
  return 0;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_jumps: %s\n", error.what());
    return 1;
  }
}
