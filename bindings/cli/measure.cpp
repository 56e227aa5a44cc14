// `mvs measure`: the read-outs of a valve as it lies in a file.
#include <memory>

#include "commands.h"
#include "readouts.h"

namespace cli {
namespace {

void run(const std::string &file, const Console &console) {
  const mvs::Snapshot valve = load(file);
  const mvs_measures measures = valve.measure();
  const mvs_load_case load_case = valve.load();
  const Json object = {{"file", file},
                       {"pressure_mmHg", load_case.pressure / pa_per_mmhg},
                       {"boundary_fraction", load_case.boundary_fraction},
                       {"intersections", measures.intersections},
                       {"measures", measures_json(measures)}};
  print(console, object,
        text("%s: as it lies in the file, load %g mmHg\n", file.c_str(),
             load_case.pressure / pa_per_mmhg) +
            measures_text(measures));
}

}  // namespace

void add_measure(CLI::App &app, Console &console) {
  auto file = std::make_shared<std::string>();
  CLI::App *command = add_command(app, console, "measure", "measure a valve as it lies in a file");
  command->add_option("file", *file, "valve to measure, .obj, .h5 or .inp")->required();
  command->callback([file, &console] { run(*file, console); });
}

}  // namespace cli
