// Cost of the leaflet's terms: energy, gradient and Hessian of the springs and of the membrane in
// every law, in one run, on the default valve and on a larger one.
//
//   bench_terms                      valves of 425 and 6,800 vertices, 50 rounds
//   bench_terms --vertices 425 --rounds 3
//   bench_terms --csv FILE
//
// Each round times every law once, one after the other, so that all of them meet the same machine;
// the columns are the fastest rounds, in microseconds (other work on the machine only ever adds),
// and their ratios to the springs'. The positions are the rest shape with every node moved somehow
// by up to 0.1 mm. "assembly" is gradient and projected Hessian, what one Newton iteration asks
// for, of the leaflet alone; "whole" the same with bending, chordae, pressure and contact.
#include <mvs/op.h>
#include <mvs/sim.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "anatomy/parametric.h"
#include "energy/total_energy.h"

using namespace mvs::core;

namespace {

struct Options {
  std::vector<uint32_t> vertices = {425, 6800};
  int rounds = 50;
  std::string csv;
};

// One law on one valve, and the seconds of every round.
struct Bench {
  std::string law;
  ModelPtr model;
  SpringTerm spring;
  MembraneTerm membrane;
  TotalEnergy total_energy;
  std::vector<Vec3> x = {}, g = {};
  HessianAssembler system = {};
  std::vector<double> energy = {}, gradient = {}, hessian = {}, assembly = {}, whole = {};
  Profile profile = {};
  double sum = 0;  // of all energies, so that the compiler removes none

  Bench(const std::string &name, const ModelPtr &of)
      : law(name), model(of), spring(*of), membrane(*of), total_energy(*of) {
    x = of->valve.rest;
    for (size_t i = 0; i < x.size(); ++i) {
      const double at = static_cast<double>(i);
      x[i] += 1e-4 * Vec3(std::sin(12.9 * at), std::sin(78.2 * at + 1), std::sin(37.7 * at + 2));
    }
  }

  bool is_spring() const { return law == "spring"; }

  static double seconds(const std::function<void()> &work) {
    const double start = seconds_now();
    work();
    return seconds_now() - start;
  }

  void begin() {
    total_energy.prepare(x, x, 1e-4, profile);
    total_energy.gradient(x, g, profile);
    total_energy.hessian(x, Curvature::projected, system, profile);
  }

  void round() {
    energy.push_back(seconds([&] { sum += is_spring() ? spring.energy(x) : membrane.energy(x); }));
    gradient.push_back(seconds([&] {
      g.assign(x.size(), Vec3::Zero());
      sum += is_spring() ? spring.gradient(x, g) : membrane.gradient(x, g);
    }));
    hessian.push_back(seconds([&] {
      system.clear();
      system.begin_term(0);  // the leaflet's term comes first, and the other one is empty
      if (is_spring()) spring.hessian(x, Curvature::projected, system);
      if (!is_spring()) membrane.hessian(x, Curvature::projected, system);
    }));
    assembly.push_back(gradient.back() + hessian.back());
    whole.push_back(seconds([&] {
      sum += total_energy.gradient(x, g, profile);
      total_energy.hessian(x, Curvature::projected, system, profile);
    }));
  }
};

double fastest(const std::vector<double> &seconds) {
  return *std::min_element(seconds.begin(), seconds.end());
}

std::deque<Bench> benches(uint32_t vertices) {
  mvs_parametric_desc desc = {};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = vertices;
  const Valve valve = make_parametric_valve(desc);
  std::deque<Bench> all;
  for (const LeafletLaw &law : leaflet_laws()) {
    Valve made = valve;
    for (size_t l = 0; l < made.leaflets.size(); ++l) {
      made.leaflets[l].law = law.id;
      made.leaflets[l].constants = default_constants(law.constants);
    }
    all.emplace_back(std::string(law.word), make_model(std::move(made)));
  }
  return all;
}

void print(uint32_t vertices, const Bench &bench, const Bench &spring, std::ofstream &csv) {
  std::printf("%8u  %-15s", vertices, bench.law.c_str());
  if (csv.is_open()) csv << vertices << ',' << bench.law;
  for (const auto column :
       {&Bench::energy, &Bench::gradient, &Bench::hessian, &Bench::assembly, &Bench::whole}) {
    const double took = fastest(bench.*column), ratio = took / fastest(spring.*column);
    std::printf("  %9.1f %6.2f", 1e6 * took, ratio);
    if (csv.is_open()) csv << ',' << 1e6 * took << ',' << ratio;
  }
  std::printf("\n");
  if (csv.is_open()) csv << '\n';
}

void run(const Options &options) {
  std::ofstream csv;
  if (!options.csv.empty()) csv.open(options.csv);
  if (csv.is_open()) {
    csv << "vertices,law,energy_us,energy_ratio,gradient_us,gradient_ratio,hessian_us,"
           "hessian_ratio,assembly_us,assembly_ratio,whole_us,whole_ratio\n";
  }
  std::printf("%8s  %-15s  %9s %6s  %9s %6s  %9s %6s  %9s %6s  %9s %6s\n", "vertices", "law",
              "energy us", "ratio", "grad. us", "ratio", "Hess. us", "ratio", "assem. us", "ratio",
              "whole us", "ratio");
  for (const uint32_t vertices : options.vertices) {
    std::deque<Bench> all = benches(vertices);
    for (Bench &bench : all) bench.begin();
    for (int k = 0; k < options.rounds; ++k) {
      for (Bench &bench : all) bench.round();
    }
    for (const Bench &bench : all) print(vertices, bench, all.front(), csv);
  }
}

}  // namespace

int main(int argc, char **argv) {
  try {
    Options options;
    CLI::App app("What the leaflet's terms cost, law by law, as ratios to the springs.");
    app.add_option("--vertices", options.vertices, "sizes of the valve");
    app.add_option("--rounds", options.rounds, "of which the fastest counts")
        ->check(CLI::PositiveNumber);
    app.add_option("--csv", options.csv, "write the table there too");
    CLI11_PARSE(app, argc, argv);
    run(options);
    return 0;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_terms: %s\n", error.what());
    return 1;
  }
}
