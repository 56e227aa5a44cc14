// `mvs chords`: the chordae of a valve with length, strain and tension, sorted.
#include "valve/chords.h"

#include <algorithm>

#include "commands/commands.h"

namespace cli {
namespace {

struct ChordsOptions {
  std::string file, sort = "tension";
};

Json chord_json(const ChordRow &row) {
  return {{"name", row.name},
          {"kind", row.kind},
          {"head", row.head.empty() ? Json() : Json(row.head)},
          {"site", row.site.empty() ? Json() : Json(row.site)},
          {"length_mm", row.length * 1e3},
          {"rest_length_mm", row.rest_length * 1e3},
          {"strain", row.strain},
          {"tension_N", row.tension},
          {"flags", row.flags}};
}

int width_of(const std::vector<ChordRow> &rows, std::string ChordRow::*column) {
  size_t width = 4;
  for (const ChordRow &row : rows) width = std::max(width, (row.*column).size());
  return static_cast<int>(width);
}

std::string chord_lines(const std::vector<ChordRow> &rows) {
  const int name = width_of(rows, &ChordRow::name), kind = width_of(rows, &ChordRow::kind),
            head = width_of(rows, &ChordRow::head), site = width_of(rows, &ChordRow::site);
  std::string table =
      text("\n  %-*s  %-*s  %-*s  %-*s  %9s  %9s  %8s  %9s  flag", name, "name", kind, "kind", head,
           "head", site, "site", "length mm", "rest mm", "strain %", "tension N");
  for (const ChordRow &row : rows) {
    table += text("\n  %-*s  %-*s  %-*s  %-*s  %9.2f  %9.2f  %8.2f  %9.4f", name, row.name.c_str(),
                  kind, row.kind.c_str(), head, row.head.c_str(), site, row.site.c_str(),
                  row.length * 1e3, row.rest_length * 1e3, row.strain * 100, row.tension);
    if (!row.flags.empty()) table += "  " + CLI::detail::join(row.flags, ", ");
  }
  return table;
}

void run_chords(const ChordsOptions &options, const Console &console) {
  const mvs::Snapshot valve = load(options.file);
  std::vector<ChordRow> rows = chord_table(valve);
  sort_chords(rows, options.sort);
  const double pressure_mmhg = valve.load().pressure / pa_per_mmhg;
  Json all = Json::array();
  for (const ChordRow &row : rows) all.push_back(chord_json(row));
  print(console,
        {{"file", options.file},
         {"pressure_mmHg", pressure_mmhg},
         {"sort", options.sort},
         {"chords", all}},
        text("%s: %zu chordae under %g mmHg, by %s", options.file.c_str(), rows.size(),
             pressure_mmhg, options.sort.c_str()) +
            chord_lines(rows));
}

}  // namespace

void add_chords(CLI::App &app, Console &console) {
  const auto [command, options] = add_command<ChordsOptions>(
      app, console, "chords",
      "list the chordae of a valve with length, strain and tension; a trunk ends where its "
      "branches end",
      run_chords);
  command->add_option("file", options->file, "valve, .obj, .h5 or .inp")->required();
  command
      ->add_option("--sort", options->sort,
                   "largest tension, strain or length first, or names in their order")
      ->capture_default_str()
      ->check(one_of(chord_orders()));
}

}  // namespace cli
