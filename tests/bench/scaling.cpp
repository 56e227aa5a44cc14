// How the cost of closing a valve grows with its vertices: cost = a n^b, fitted by least squares on
// the logarithms, for the whole closure and for each phase.
//
//   bench_scaling                    springs, scenes S to XL, one run each (XL takes a minute)
//   bench_scaling --leaflet membrane --scenes S M L
//   bench_scaling --csv FILE
//
// The goal is b = 1.25 at most: nested dissection of a sheet costs n^1.5 a factorisation, so that
// only fewer of them on finer meshes can stay below that.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "tests/bench/closing.h"
#include "tests/bench/table.h"

using namespace bench;

namespace {

struct Options {
  std::vector<std::string> scenes = {"S", "M", "L", "XL"};
  Case of;
  int repeat = 1;
  std::string csv;
};

// The slope of y over x; x and y positive.
double exponent(const std::vector<double> &x, const std::vector<double> &y) {
  const double n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (size_t k = 0; k < x.size(); ++k) {
    const double a = std::log(x[k]), b = std::log(y[k]);
    sx += a;
    sy += b;
    sxx += a * a;
    sxy += a * b;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

struct Cost {
  std::string name;
  std::vector<double> of;  // one value for each scene
};

std::vector<Cost> costs(const std::vector<Closing> &closings) {
  std::vector<Cost> all = {{"closure", {}}, {"iterations", {}}};
  for (const std::string &phase : phase_names) all.push_back({phase, {}});
  all.push_back({"other", {}});
  for (const Closing &closing : closings) {
    all[0].of.push_back(closing.cpu() * 1e3);
    all[1].of.push_back(closing.stats.iterations);
    for (size_t k = 0; k < phase_names.size(); ++k) all[2 + k].of.push_back(closing.phase(k) * 1e3);
    all.back().of.push_back(closing.other() * 1e3);
  }
  return all;
}

void run(const Options &options) {
  std::vector<Closing> closings;
  std::vector<double> vertices;
  std::vector<std::string> columns = {"cost, ms of CPU"};
  for (const std::string &scene : options.scenes) {
    Case of = options.of;
    of.scene = scene;
    closings.push_back(close(of, options.repeat));
    vertices.push_back(static_cast<double>(closings.back().vertices));
    columns.push_back(scene + " " + std::to_string(closings.back().vertices));
    if (!closings.back().at_rest()) std::printf("%s did not come to rest\n", scene.c_str());
  }
  columns.push_back("exponent");
  Table table(columns, options.csv);
  for (const Cost &cost : costs(closings)) {
    std::vector<Cell> cells = {cost.name};
    bool some = true;
    for (const double value : cost.of) {
      cells.push_back(value);
      some = some && value > 0;
    }
    cells.push_back(some ? Cell(exponent(vertices, cost.of)) : Cell("none"));
    table.row(cells);
  }
}

}  // namespace

int main(int argc, char **argv) {
  try {
    Options options;
    CLI::App app("How the cost of closure grows with the mesh.", "bench_scaling");
    app.add_option("--scenes", options.scenes, "S 425, M 1700, L 6800, XL 27000 vertices")
        ->capture_default_str()
        ->check(CLI::IsMember(keys(scene_vertices)));
    app.add_option("--leaflet", options.of.leaflet, "spring or membrane")
        ->capture_default_str()
        ->check(CLI::IsMember({"spring", "membrane"}));
    app.add_option("--repeat", options.repeat, "runs of each, of which the median counts")
        ->check(CLI::PositiveNumber);
    app.add_option("--csv", options.csv, "file to write the table to");
    CLI11_PARSE(app, argc, argv);
    run(options);
    return 0;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_scaling: %s\n", error.what());
    return 1;
  }
}
