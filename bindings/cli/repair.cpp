// `mvs repair`: a valve before and after a surgical plan, both closed and measured.
#include <cstdio>
#include <memory>

#include "commands.h"
#include "plan_file.h"
#include "readouts.h"

namespace cli {
namespace {

struct Options {
  std::string file, plan, out, plan_out;
  double pressure_mmhg = 120;
};

struct Side {
  mvs::Snapshot valve;
  mvs_stats stats;
  mvs_measures measures;
};

mvs::Sim loaded(const Options &options, Progress &progress) {
  mvs_sim_desc desc = {};
  desc.progress = Progress::callback;
  desc.user = &progress;
  mvs::Sim sim = make_sim(desc);
  sim.load_file(options.file);
  return sim;
}

Side close_valve(const Options &options, mvs::Sim &sim) {
  sim.set_load(options.pressure_mmhg * pa_per_mmhg);
  const mvs_stats stats = sim.settle();
  mvs::Snapshot valve = sim.snapshot();
  const mvs_measures measures = valve.measure();
  if (!stats.converged) {
    std::fprintf(stderr, "mvs: warning: %s is not at rest after %u iterations, residual %.1e N\n",
                 options.file.c_str(), stats.iterations, stats.residual);
  }
  return {std::move(valve), stats, measures};
}

Json side_json(const Side &side) {
  return {{"converged", side.stats.converged != 0},
          {"iterations", side.stats.iterations},
          {"residual_N", side.stats.residual},
          {"intersections", side.measures.intersections},
          {"hash", hash_of(side.valve)},
          {"measures", measures_json(side.measures)}};
}

std::vector<std::string> titles(const mvs::Snapshot &valve) {
  std::vector<std::string> out;
  mvs_history history = mvs::sized<mvs_history>();
  mvs::must(mvs_snapshot_history(valve.get(), &history));
  for (uint32_t k = 0; k < history.done; ++k) {
    mvs_history_entry entry = mvs::sized<mvs_history_entry>();
    mvs::must(mvs_snapshot_history_entry(valve.get(), k, &entry));
    out.push_back(entry.title);
  }
  return out;
}

void run(const Options &options, const Console &console) {
  const std::string plan = plan_text(options.plan);
  Progress progress(console);
  mvs::Sim as_it_is = loaded(options, progress), repaired = loaded(options, progress);
  // a plan that cannot be done is told before anything takes long
  repaired.check_plan(plan);
  const Side before = close_valve(options, as_it_is);
  const mvs_replay replay = repaired.replay_plan(plan);
  const Side after = close_valve(options, repaired);
  if (!options.out.empty()) after.valve.save(options.out);
  if (!options.plan_out.empty()) {
    mvs_plan_options with_measures = {};
    with_measures.measures = 1;
    after.valve.save_plan(options.plan_out, with_measures);
  }
  std::string human = text("%s repaired by %s under %g mmHg\n", options.file.c_str(),
                           options.plan.c_str(), options.pressure_mmhg);
  for (const std::string &title : titles(after.valve)) human += "  - " + title + "\n";
  print(console,
        {{"file", options.file},
         {"plan", options.plan},
         {"pressure_mmHg", options.pressure_mmhg},
         {"same_valve", replay.same_valve != 0},
         {"operations", titles(after.valve)},
         {"before", side_json(before)},
         {"after", side_json(after)}},
        human + measures_text(before.measures, after.measures));
}

}  // namespace

void add_repair(CLI::App &app, Console &console) {
  auto options = std::make_shared<Options>();
  CLI::App *command =
      add_command(app, console, "repair", "close and measure a valve before and after a plan");
  command->add_option("file", options->file, "valve to repair, .obj or .h5")->required();
  command->add_option("--plan", options->plan, "surgical plan, .json")->required();
  command->add_option("-o,--output", options->out, "write the repaired, closed valve");
  command->add_option("--save-plan", options->plan_out,
                      "write the plan as done, with measures before and after each operation");
  command->add_option("--pressure", options->pressure_mmhg, "transvalvular pressure, mmHg")
      ->capture_default_str()
      ->check(CLI::Number);
  command->callback([options, &console] { run(*options, console); });
}

}  // namespace cli
