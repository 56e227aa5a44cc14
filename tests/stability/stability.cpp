// Plays operations, loads, starts and meshes far outside of clinical use, and prints the result of
// each (README.md lists the criteria).
//
//   stability                        the short suite, two minutes
//   stability --long                 every valve, every chord, 10,000 scripts (MVS_TEST_LONG=1)
//   stability --group boundary --case annulus --valve S --mode live
//   stability --csv FILE             also as a table
//
// Exit code 1: a row failed that is not known to.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "tests/stability/case.h"
#include "tests/stability/table.h"
#include "tests/stability/valves.h"

using namespace stability;

namespace {

struct Options {
  bool lengthy = false;
  std::string group, part, valve, mode, csv;
};

double cpu_now() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

std::vector<Case> all_cases(const Options &options) {
  std::vector<Case> all;
  for (const auto &some : {boundary_cases(), chord_cases(options.lengthy), load_cases(),
                           start_cases(), mesh_cases(), tool_cases()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

Row play(const Case &one, const std::string &valve, SolverMode mode, const Options &options) {
  Row row{one.name, valve, mode, {}, 0};
  Effort effort;
  if (options.lengthy) effort.implicit = 20000;
  effort.may_refuse = one.may_refuse;
  // so that no case includes the time of the closure that it starts from
  if (!one.prepare) closed_valve(valve);
  const double start = cpu_now();
  Watch watch(mode, effort);
  try {
    if (one.prepare) {
      one.prepare(watch, valve);
    } else {
      mvs::must(mvs_restore(watch.sim().get(), closed_valve(valve).get()));
    }
    if (watch.is_laid_out()) {
      watch.begin();
      one.play(watch);
    }
    row.verdict = watch.finish();
  } catch (const std::exception &error) {
    row.verdict = watch.failed(error.what());
  }
  row.cpu_s = cpu_now() - start;
  return row;
}

bool wanted(const Options &options, const Case &one) {
  const std::string group = one.name.substr(0, one.name.find('/'));
  return (options.group.empty() || options.group == group) &&
         one.name.find(options.part) != std::string::npos;
}

std::vector<std::string> valves_of(const Case &one, const Options &options) {
  std::vector<std::string> valves = one.valves;
  if (options.lengthy) valves.insert(valves.end(), one.more.begin(), one.more.end());
  if (!options.valve.empty()) valves = {options.valve};
  return valves;
}

std::vector<Row> play_all(const Options &options) {
  std::vector<Row> rows;
  print_head();
  for (const Case &one : all_cases(options)) {
    if (!wanted(options, one)) continue;
    for (const std::string &valve : valves_of(one, options)) {
      if (!is_there(valve)) {
        std::printf("%-32s %-5s left out: it is not in MVS_TEST_DATA\n", one.name.c_str(),
                    valve.c_str());
        continue;
      }
      for (const SolverMode mode : one.modes) {
        if (!options.mode.empty() && options.mode != name_of(mode)) continue;
        rows.push_back(play(one, valve, mode, options));
        print(rows.back());
      }
    }
  }
  return rows;
}

int tell(const std::vector<Row> &rows) {
  size_t passed = 0, failed = 0, known = 0, better = 0, resting = 0;
  for (const Row &row : rows) {
    const std::string verdict = verdict_of(row);
    passed += verdict == "passed";
    failed += verdict == "FAILED";
    known += verdict == "known";
    better += verdict == "BETTER";
    resting += row.verdict.at_rest;
    if (verdict == "known" || verdict == "BETTER") {
      std::printf("%s: %s on %s, %s: %s\n", verdict.c_str(), row.name.c_str(), row.valve.c_str(),
                  name_of(row.mode), known_reason(row).c_str());
    }
  }
  std::printf(
      "%zu rows: %zu passed, %zu failed, %zu failed as known, %zu known and yet passed; "
      "%zu came to rest\n",
      rows.size(), passed, failed, known, better, resting);
  return failed > 0 || rows.empty() ? 1 : 0;
}

int run(int argc, char **argv) {
  Options options;
  const char *lengthy = std::getenv("MVS_TEST_LONG");
  options.lengthy = lengthy && *lengthy;
  CLI::App app("Plays what should not be done to a valve, and says what came of it.", "stability");
  app.add_flag("--long", options.lengthy, "every valve, every chord, more scripts");
  app.add_option("--group", options.group, "boundary, chords, loads, starts, meshes, tools");
  app.add_option("--case", options.part, "cases whose name has this in it");
  app.add_option("--valve", options.valve, "this valve: S, S2, M, L, XL, N32");
  app.add_option("--mode", options.mode, "newton, implicit or live");
  app.add_option("--csv", options.csv, "file to write the table to");
  CLI11_PARSE(app, argc, argv);
  const std::vector<Row> rows = play_all(options);
  if (!options.csv.empty()) write_csv(rows, options.csv);
  return tell(rows);
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "stability: %s\n", error.what());
    return 1;
  }
}
