// `mvs cost`: the cost of the repair of a closed valve.
#include <cstdio>

#include "commands/commands.h"
#include "text/output_file.h"
#include "text/readouts.h"
#include "valve/cost.h"

namespace cli {
namespace {

struct CommandOptions {
  std::string file, out;
  CostOptions cost;
};

std::string words_of_load(double pressure) {
  if (pressure == 0) return "under no pressure";
  return text(pressure > 0 ? "closed under %g mmHg" : "open under %g mmHg", pressure / pa_per_mmhg);
}

void run_cost(const CommandOptions &options, Console &console) {
  demand_writable_valve(options.out);
  const mvs::Snapshot closed = load(options.file);
  const CostMeter meter(options.cost);
  Progress progress(console);
  const mvs::Cost cost = meter.of(closed, &progress);
  if (!options.out.empty()) cost.opened.save(options.out);
  const double pressure = closed.load().pressure;
  if (!(pressure > 0)) {
    std::fprintf(stderr,
                 "mvs: warning: %s is %s: figures of the closed valve are meaningless; "
                 "close it first: mvs close %s -o closed.h5\n",
                 options.file.c_str(), words_of_load(pressure).c_str(), options.file.c_str());
  }
  const std::string state = closed.at_rest() ? "at rest" : "not at rest";
  print(console,
        {{"file", options.file},
         {"pressure_mmHg", pressure / pa_per_mmhg},
         {"diastole_mmHg", options.cost.diastole_mmhg},
         {"at_rest", closed.at_rest()},
         {"cost", cost_json(cost.figures)}},
        text("%s: %s, %s; opened by %g mmHg\n", options.file.c_str(),
             words_of_load(pressure).c_str(), state.c_str(), options.cost.diastole_mmhg) +
            cost_text(cost.figures));
  if (cost.figures.opened == 0) {
    std::fprintf(stderr, "mvs: warning: the open valve did not come to rest: no open area\n");
    console.exit_code = 1;
  }
}

}  // namespace

void add_cost(CLI::App &app, Console &console) {
  const auto [command, options] = add_command<CommandOptions>(
      app, console, "cost",
      "show the cost of a repair: area of the valve opened in diastole, gradient of a flow, "
      "leaflet lengths and risk of SAM, pull on the annulus, chordae beyond limits",
      run_cost);
  command->add_option("file", options->file, "closed valve, .obj, .h5 or .inp")->required();
  command->add_option("-o,--output", options->out, "file for the open valve");
  add_cost_options(*command, options->cost);
  add_progress_flag(*command, console);
}

}  // namespace cli
