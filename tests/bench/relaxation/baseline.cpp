// A baseline at its best on any valve: the founding paper's explicit method, or dynamic relaxation
// with viscous or kinetic damping. For time_error.py.
//
//   bench_baseline METHOD            explicit, viscous or kinetic, on scene S
//   bench_baseline METHOD --valve FILE --residual 1e-3 -o closed.obj
//
// FILE is a valve with its load. Prints one line of CSV under its header; CPU seconds are those of
// the closure with the settings found, without the search for them.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>

#include "tests/bench/founding.h"
#include "tests/bench/relaxation/relaxed_closing.h"

using namespace bench;

namespace {

struct Found {
  Closing closing;
  std::string settings;
};

Found close_at_best(const std::string &method, const Case &of) {
  if (method == "explicit") {
    const Founding best = close_founding(of);
    char words[80];
    std::snprintf(words, sizeof words, "steps of %.3g us and a damping of %.3g /s",
                  best.taken.dt * 1e6, best.taken.damping);
    return {best.closing, words};
  }
  const Relaxed best = close_relaxed(of, method == "viscous" ? Damping::viscous : Damping::kinetic);
  return {best.closing, words_of(best)};
}

void tell(const std::string &method, const Found &found) {
  const Closing &closing = found.closing;
  std::printf("method,converged,diverged,stable,steps,cpu_s,residual_N,crossings,settings\n");
  std::printf("%s,%s,%s,%s,%u,%.6g,%.4g,%u,\"%s\"\n", method.c_str(),
              closing.at_rest() ? "yes" : "no", closing.diverged ? "yes" : "no",
              closing.stats.stable ? "yes" : "no", closing.stats.iterations, closing.cpu(),
              closing.stats.residual, closing.measures.intersections, found.settings.c_str());
}

int run(int argc, char **argv) {
  std::string method, output;
  Case of;
  of.solver = "explicit";
  CLI::App app("Closes a valve with a baseline at its best.", "bench_baseline");
  app.add_option("method", method, "explicit, viscous or kinetic")
      ->required()
      ->check(CLI::IsMember({"explicit", "viscous", "kinetic"}));
  app.add_option("--valve", of.file, "file of a valve with its load [scene S]");
  app.add_option("--residual", of.residual, "N, at which a valve is at rest")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--dt", of.dt, "s, of explicit [searched]")->check(CLI::PositiveNumber);
  app.add_option("--damping", of.damping, "1/s, of explicit [searched]")
      ->check(CLI::PositiveNumber);
  app.add_option("--steps", of.most, "at most, of relaxation [4000]")->check(CLI::PositiveNumber);
  app.add_option("-o", output, "file for the closed valve, extended OBJ");
  CLI11_PARSE(app, argc, argv);
  const Found found = close_at_best(method, of);
  tell(method, found);
  if (!output.empty() && !(std::ofstream(output) << found.closing.closed)) {
    throw std::runtime_error("could not write " + output);
  }
  return 0;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_baseline: %s\n", error.what());
    return 1;
  }
}
