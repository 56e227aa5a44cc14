// `mvs measure`: the read-outs of a valve in the state stored in its file.
#include "commands/commands.h"
#include "text/readouts.h"

namespace cli {
namespace {

struct MeasureOptions {
  std::string file;
};

void run_measure(const MeasureOptions &options, const Console &console) {
  const mvs::Snapshot valve = load(options.file);
  const mvs_measures measures = valve.measure();
  const mvs_load_case load_case = valve.load();
  const double pressure_mmhg = load_case.pressure / pa_per_mmhg;
  print(console,
        {{"file", options.file},
         {"pressure_mmHg", pressure_mmhg},
         {"boundary_fraction", load_case.boundary_fraction},
         {"intersections", measures.intersections},
         {"measures", measures_json(measures)}},
        text("%s: as stored in the file, load %g mmHg, %s\n", options.file.c_str(), pressure_mmhg,
             measures.at_rest != 0 ? "at rest" : "not at rest") +
            measures_text(measures));
}

}  // namespace

void add_measure(CLI::App &app, Console &console) {
  const auto [command, options] = add_command<MeasureOptions>(
      app, console, "measure", "measure a valve as stored in a file", run_measure);
  command->add_option("file", options->file, "valve to measure, .obj, .h5 or .inp")->required();
}

}  // namespace cli
