// `mvs import`: builds a valve from a patient's surface and landmarks.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

#include "commands/commands.h"
#include "import/findings_file.h"
#include "import/import_input.h"
#include "import/landmark_names.h"
#include "text/output_file.h"
#include "valve/tissue.h"

namespace cli {
namespace {

constexpr uint32_t most_cores = 8;  // a build has at most 13 closures at the same time

std::string findings_path(const ImportOptions &options) {
  if (!options.findings_out.empty()) return options.findings_out;
  return std::filesystem::path(options.out).replace_extension(".import.json").string();
}

// Names on stderr the parts of an OBJ file of a whole valve that are not used.
void warn_of_whole_valve(const std::string &path) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("#mvs ")) continue;
    std::fprintf(stderr,
                 "mvs: warning: %s is a whole valve: its annulus, chordae, papillary heads and "
                 "tissue are not used, only the surface of its leaflets; mvs close reads it as it "
                 "is\n",
                 path.c_str());
    return;
  }
}

// Names inputs that contradict the surface on stderr, such as swapped labels and landmarks of
// another frame: the valve is written all the same, and most readers of JSON look at its values.
void warn_of_contradictions(const std::vector<mvs::Finding> &findings) {
  for (const mvs::Finding &finding : findings) {
    if (!finding.doubtful) continue;
    std::fprintf(stderr, "mvs: warning: %s, %.0f %% sure: %s\n", finding.name.c_str(),
                 100 * finding.confidence, finding.sentence.c_str());
  }
}

// Names edited values of an earlier import that are not used, as the build measures them again.
void warn_of_ignored(const KnownValues &known, const std::string &path) {
  for (const std::string &name : known.ignored) {
    std::fprintf(stderr, "mvs: warning: %s: the edited value of \"%s\" is not used: %s\n",
                 path.c_str(), name.c_str(),
                 is_input(name) ? "it was measured, and is measured again; change its source to "
                                  "\"given\" if it is known"
                                : "it is a result of the build and no input");
  }
}

void run_import(const ImportOptions &given, Console &console) {
  ImportOptions options = given;
  options.build.edge = options.edge * 1e-3;
  options.build.thickness = options.thickness * 1e-3;
  options.build.coaptation_length = options.coaptation_length * 1e-3;
  options.build.edge_error = options.edge_error * 1e-3;
  options.build.edge_lost = options.edge_lost * 1e-3;
  options.build.thickness_error = options.thickness_error * 1e-3;
  options.build.closed_error = options.closed_error * 1e-3;
  options.build.leaflet_law = law_of(options.leaflet);
  options.build.without_leak = options.no_leak ? 1 : 0;
  const std::string path = findings_path(options);
  demand_writable_valve(options.out);
  demand_writable(path);
  demand_apart({{options.out, "the valve"}, {path, "the findings"}},
               {options.surface, options.annulus, options.commissures, options.anterior,
                options.tips, options.closed, options.closed_annulus, options.closed_tips});
  KnownValues known;
  const ImportInput input = read_input(given, options, known);
  warn_of_whole_valve(options.surface);
  const std::string name = std::filesystem::path(options.surface).stem().string();
  Progress progress(console);
  mvs_sim_desc how = with_workers(console);
  if (how.workers == 0) {
    how.workers = std::clamp(std::thread::hardware_concurrency(), 1u, most_cores);
  }
  how.progress = &Progress::callback;
  how.user = &progress;
  mvs::Simulator sim = make_sim(how);
  std::vector<mvs::Finding> findings = with_file_contents(
      [&] { return mvs::build_valve(sim, desc_of(input, options, name), options.build); });
  keep_doubts(known, findings);
  warn_of_ignored(known, options.with);
  warn_of_contradictions(findings);
  warn_of_names(input.files, {options.commissures, options.tips}, findings);
  const mvs::Snapshot valve = sim.snapshot();
  valve.save(options.out);
  write_findings(path, options.surface, findings);
  const Size size = size_of(valve);
  print(
      console,
      {{"file", options.out},
       {"vertices", size.vertices},
       {"faces", size.faces},
       {"chords", size.chords},
       {"heads", size.heads},
       {"frame", frame_name(input.files.frame())},
       {"hash", hash_of(valve)},
       {"findings_file", path},
       {"findings", findings_json(findings)}},
      text("%s: an open valve of %zu leaflet vertices, %zu triangles, %zu chordae, %zu papillary "
           "heads\n%s: what was found, guessed and assumed; edit it and give it by --with",
           options.out.c_str(), size.vertices, size.faces, size.chords, size.heads, path.c_str()) +
          findings_text(findings));
}

void add_landmark_options(CLI::App &command, ImportOptions &options) {
  const auto landmark = [&](const char *name, std::string &to, const char *help) {
    command.add_option(name, to, std::string(help) + ": .mrk.json, .fcsv, .csv, .vtk, .vtp");
  };
  landmark("--annulus", options.annulus,
           "points or a curve along the annulus; tissue beyond it is cut off");
  landmark("--commissures", options.commissures, "the two commissures");
  landmark("--anterior", options.anterior, "one point of the anterior leaflet");
  landmark("--tips", options.tips, "tips of the papillary muscles");
  landmark("--closed-annulus", options.closed_annulus,
           "points or a curve along the annulus under load [near rims of --closed]");
  landmark("--closed-tips", options.closed_tips,
           "the tips of --tips in the same order, under load [they follow the annulus as a whole]");
}

void add_range_options(CLI::App &command, ImportOptions &options) {
  command
      .add_option(
          "--edge-error", options.edge_error,
          "how far the free edge may lie farther out or in, mm: widens the interval of leaks "
          "[0]")
      ->check(between(0.001, 5, "mm"));
  command
      .add_option("--edge-lost", options.edge_lost,
                  "tissue that may be missing at the free edge, mm: widens the interval of leaks "
                  "[half of the mean depth of its filled notches; 0.001: none]")
      ->check(between(0.001, 5, "mm"));
  command
      .add_option("--thickness-error", options.thickness_error,
                  "by how much the leaflets may be thicker or thinner, mm: widens the interval of "
                  "leaks [0]")
      ->check(between(0.001, 2, "mm"));
  command
      .add_option("--closed-error", options.closed_error,
                  "standard deviation of places of --closed, mm: gaps of it widen the interval of "
                  "leaks from 3.6 times as much of width on, of tissue thicker than twice as much, "
                  "or 1, from as much more [0.5, as of labels of networks]")
      ->needs(command.get_option("--closed"))
      ->check(between(0.001, 5, "mm"));
  command.add_flag("--no-leak", options.no_leak,
                   "leave the leak and its interval out, which take most of the time of an import "
                   "without --closed; mvs leak finds them later");
}

}  // namespace

void add_import(CLI::App &app, Console &console) {
  const auto [command, options] = add_command<ImportOptions>(
      app, console, "import",
      "build a valve from a surface of open leaflets and what is known of annulus, commissures and "
      "papillary muscles",
      run_import);
  command
      ->add_option("surface", options->surface, "open leaflets: .stl, .ply, .obj, .off, .vtk, .vtp")
      ->required();
  command->add_option("-o,--output", options->out, "file for the valve, .h5, .obj, .vtp or .vtm")
      ->required();
  add_file_options(*command, options->files);
  add_landmark_options(*command, *options);
  command->add_option("--closed", options->closed,
                      "the same leaflets closed, a mid-surface or a skin: chords get lengths with "
                      "which the valve closes to them");
  command
      ->add_option("--kind", options->kind,
                   "mid: the mid-surface; atrial: the atrial side; skin: both sides, closed "
                   "[skin if it is closed, else mid]")
      ->check(one_of({"mid", "atrial", "skin"}));
  command->add_option("--labels", options->label_array,
                      "array of the surface: 1 anterior, 2 posterior, 0 unknown, per triangle");
  auto *array = command->add_option("--thickness-array", options->thickness_array,
                                    "array of the surface: thickness per point, in its unit");
  command->add_option("--thickness", options->thickness, "of the leaflets, mm [0.8]")
      ->check(between(0.1, 5, "mm"))
      ->excludes(array);
  command->add_option("--edge", options->edge, "sides of the new triangles, mm [1,000 vertices]")
      ->check(between(0.2, 5, "mm"));
  command
      ->add_option("--coaptation-length", options->coaptation_length,
                   "overlap in the middle for which rest lengths are chosen, mm [8]")
      ->check(between(1, 20, "mm"));
  command
      ->add_option("--chord-slack", options->build.chord_factor,
                   "factor on the rest length of every chord [1]")
      ->check(between(0.5, 2));
  command->add_option("--chords", options->build.chords, "chord segments, about [100]")
      ->check(between(20, 400));
  add_range_options(*command, *options);
  add_law_option(*command, options->leaflet, "membrane; with --closed the nearest one");
  command->add_option("--with", options->with,
                      "findings of an earlier import, edited: what is given, guessed or assumed in "
                      "them is used");
  command->add_option("--findings", options->findings_out,
                      "file for the findings [VALVE.import.json beside the output]");
  add_workers_option(*command, console,
                     "threads that close variants of the valve at the same time; the result is the "
                     "same for any number [the cores of the machine, at most 8]");
  add_progress_flag(*command, console);
}

}  // namespace cli
