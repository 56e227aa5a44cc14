// `mvs measure`: the read-outs of a valve in the state stored in its file.
#include <algorithm>

#include "commands/commands.h"
#include "text/readouts.h"

namespace cli {
namespace {

struct MeasureOptions {
  std::string file;
  std::vector<std::string> only;  // words of groups; none: all groups
};

std::vector<std::string> group_words() {
  std::vector<std::string> words;
  for (const auto &[word, bit] : measure_groups()) words.push_back(word);
  return words;
}

mvs_measure_group_flags groups_of(const std::vector<std::string> &only) {
  mvs_measure_group_flags groups = 0;
  for (const auto &[word, bit] : measure_groups()) {
    const bool is_chosen = std::find(only.begin(), only.end(), word) != only.end();
    if (is_chosen || only.empty()) groups |= bit;
  }
  return groups;
}

void run_measure(const MeasureOptions &options, const Console &console) {
  const mvs::Snapshot valve = load(options.file);
  const mvs_measure_group_flags groups = groups_of(options.only);
  // crossings also decide whether a leak has a grade
  const mvs_measures measures = valve.measure(groups | MVS_MEASURE_GROUP_CROSSINGS);
  const mvs_load_case load_case = valve.load();
  const double pressure_mmhg = load_case.pressure / pa_per_mmhg;
  Json object = {{"file", options.file},
                 {"pressure_mmHg", pressure_mmhg},
                 {"boundary_fraction", load_case.boundary_fraction}};
  if ((groups & MVS_MEASURE_GROUP_CROSSINGS) != 0) object["intersections"] = measures.intersections;
  object["measures"] = measures_json(measures, groups);
  print(console, object,
        text("%s: as stored in the file, load %g mmHg, %s\n", options.file.c_str(), pressure_mmhg,
             measures.at_rest != 0 ? "at rest" : "not at rest") +
            measures_text(measures, groups));
}

}  // namespace

void add_measure(CLI::App &app, Console &console) {
  const auto [command, options] = add_command<MeasureOptions>(
      app, console, "measure", "measure a valve as stored in a file", run_measure);
  command->add_option("file", options->file, "valve to measure, .obj, .h5 or .inp")->required();
  command->add_option("--only", options->only, "compute and print these groups, joined by ','")
      ->delimiter(',')
      ->check(one_of(group_words()));
}

}  // namespace cli
