// `mvs repair`: closes and measures a valve before and after a surgical plan.
#include <optional>

#include "commands/commands.h"
#include "text/output_file.h"
#include "text/plan_file.h"
#include "text/readouts.h"
#include "valve/at_rest.h"
#include "valve/pressure.h"
#include "valve/slack_chordae.h"

namespace cli {
namespace {

struct RepairOptions {
  std::string file, plan, out, plan_out;
  std::optional<double> pressure_mmhg;
  bool allow_unsettled = false;
};

void run_repair(const RepairOptions &options, Console &console) {
  demand_writable_valve(options.out);
  demand_writable(options.plan_out);
  // the repaired valve may take the place of the valve, as that of other commands
  demand_apart({{options.out, "the valve"}, {options.plan_out, "the plan"}}, {options.plan});
  demand_apart({{options.plan_out, "the plan"}}, {options.file});
  const std::string plan = plan_text(options.plan);
  Progress progress(console);
  mvs::Simulator unrepaired = load_sim(options.file, progress, with_workers(console));
  mvs::Simulator repaired = load_sim(options.file, progress, with_workers(console));
  // an inapplicable plan fails before the closures, which take longer
  with_file_contents([&] { repaired.check_plan(plan); });
  const double pressure_mmhg = pressure_mmhg_of(options.pressure_mmhg, unrepaired);
  const AtRest before = settle(unrepaired, pressure_mmhg, options.file + " before");
  const mvs_replay replay = with_file_contents([&] { return repaired.replay_plan(plan); });
  const AtRest after = settle(repaired, pressure_mmhg, options.file + " after");
  const std::vector<SlackChord> slack = slack_new_chordae(after);
  if (!options.out.empty()) after.valve.save(options.out);
  if (!options.plan_out.empty()) {
    mvs_plan_options with_measures = {};
    with_measures.measures = 1;
    after.valve.save_plan(options.plan_out, with_measures);
  }
  std::string lines = text("%s repaired by %s under %g mmHg\n", options.file.c_str(),
                           options.plan.c_str(), pressure_mmhg);
  Json titles = Json::array();
  for (const mvs_history_entry &entry : after.valve.history().done) {
    titles.push_back(entry.title);
    lines += text("  - %s\n", entry.title);
  }
  print(console,
        {{"file", options.file},
         {"plan", options.plan},
         {"pressure_mmHg", pressure_mmhg},
         {"same_valve", replay.same_valve != 0},
         {"operations", titles},
         {"before", at_rest_json(before)},
         {"after", at_rest_json(after)},
         {"slack_new_chordae", slack_json(slack)}},
        lines + measures_text(before.measures, after.measures));
  demand_rest(console, before.stats, options.allow_unsettled);
  demand_rest(console, after.stats, options.allow_unsettled);
}

}  // namespace

void add_repair(CLI::App &app, Console &console) {
  const auto [command, options] = add_command<RepairOptions>(
      app, console, "repair", "close and measure a valve before and after a plan", run_repair);
  command->add_option("file", options->file, "valve to repair, .obj or .h5")->required();
  command->add_option("--plan", options->plan, "surgical plan, .json")->required();
  command->add_option("-o,--output", options->out, "write the repaired, closed valve");
  command->add_option("--save-plan", options->plan_out,
                      "write the applied plan, with measures before and after each operation");
  add_pressure_option(*command, options->pressure_mmhg);
  add_unsettled_option(*command, options->allow_unsettled);
  add_workers_option(*command, console);
}

}  // namespace cli
