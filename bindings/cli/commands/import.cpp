// `mvs import`: builds a valve from a patient's surface and landmarks.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "commands/commands.h"
#include "import/findings_file.h"
#include "import/landmarks.h"
#include "valve/tissue.h"

namespace cli {
namespace {

constexpr double least_confidence = 0.1;  // of a finding: up to it, an input is taken for wrong

struct ImportOptions {
  std::string surface, out, findings_out, with;
  std::string annulus, commissures, anterior, tips, closed;
  std::string kind, leaflet, label_array, thickness_array;
  FileOptions files;
  double edge = 0, thickness = 0, coaptation_length = 0;      // mm
  double edge_error = 0, edge_lost = 0, thickness_error = 0;  // mm
  mvs_build_options build = {};
};

mvs_surface_kind kind_number(const std::string &kind) {
  if (kind == "mid") return MVS_SURFACE_KIND_MID;
  if (kind == "atrial") return MVS_SURFACE_KIND_ATRIAL;
  return kind == "skin" ? MVS_SURFACE_KIND_SKIN : 0;
}

// The values of a named array of the surface, one a row.
std::vector<double> array_values(const mvs::SurfaceFile &file, const std::string &name,
                                 mvs_surface_place place) {
  std::string known;
  for (const mvs_surface_array &array : file.arrays()) {
    if (array.place == place && name == array.name && array.values.components == 1) {
      const mvs::View<double> view(array.values);
      return {view.begin(), view.end()};
    }
    known += std::string(known.empty() ? "" : ", ") + array.name;
  }
  fail(MVS_E_ARGUMENT, name,
       "the surface has no array \"" + name + "\" with one value for each " +
           (place == MVS_SURFACE_PLACE_POINT ? "point" : "triangle") +
           (known.empty() ? "; it has no arrays" : "; it has: " + known));
}

std::vector<uint32_t> labels_of(const mvs::SurfaceFile &file, const std::string &name) {
  std::vector<uint32_t> labels;
  for (const double value : array_values(file, name, MVS_SURFACE_PLACE_TRIANGLE)) {
    if (value != 0 && value != 1 && value != 2) {
      fail(MVS_E_ARGUMENT, name,
           text("the array \"%s\" has the value %g: 0 is unknown, 1 anterior, 2 posterior",
                name.c_str(), value));
    }
    labels.push_back(static_cast<uint32_t>(value));
  }
  return labels;
}

// Input of a build, with the memory that the description points to.
struct Input {
  PatientFiles files;
  std::vector<double> points, annulus, commissures, anterior, tips, thickness, closed;
  std::vector<uint32_t> labels;
};

mvs_array array_of(const mvs_view &view) {
  return {view.data, view.count, view.components, view.type, view.stride};
}

mvs_array points_of(const std::vector<double> &values) {
  if (values.empty()) return {};
  return {values.data(), values.size() / 3, 3, MVS_TYPE_F64, 0};
}

mvs_surface_desc desc_of(const Input &input, const ImportOptions &options,
                         const std::string &name) {
  mvs_surface_desc desc = {};
  desc.kind = kind_number(options.kind);
  desc.name = name.c_str();
  desc.points = points_of(input.points);
  desc.triangles = array_of(input.files.file(options.surface).info().triangles);
  if (!input.labels.empty()) {
    desc.triangle_leaflet = {input.labels.data(), input.labels.size(), 1, MVS_TYPE_U32, 0};
  }
  if (!input.thickness.empty()) {
    desc.point_thickness = {input.thickness.data(), input.thickness.size(), 1, MVS_TYPE_F64, 0};
  }
  desc.annulus = points_of(input.annulus);
  desc.commissures = points_of(input.commissures);
  desc.anterior = points_of(input.anterior);
  desc.papillary_tips = points_of(input.tips);
  if (!options.closed.empty()) {
    desc.closed_points = points_of(input.closed);
    desc.closed_triangles = array_of(input.files.file(options.closed).info().triangles);
  }
  return desc;
}

Input read_input(const ImportOptions &options, ImportOptions &with_known) {
  const KnownValues known = options.with.empty() ? KnownValues{} : read_findings(options.with);
  Input input{PatientFiles(options.files, options.surface), {}, {}, {}, {}, {}, {}, {}, {}};
  PatientFiles &files = input.files;
  for (const std::string *path :
       {&options.annulus, &options.commissures, &options.anterior, &options.tips}) {
    files.add_landmarks(*path);
  }
  files.add_surface(options.closed);
  files.settle_frames();
  const auto landmarks = [&](const std::string &path, const std::vector<double> &else_known) {
    return path.empty() ? else_known : files.points(path);
  };
  input.points = files.points(options.surface);
  input.annulus = landmarks(options.annulus, known.annulus);
  input.commissures = landmarks(options.commissures, known.commissures);
  input.anterior = landmarks(options.anterior, known.anterior);
  input.tips = landmarks(options.tips, known.papillary_tips);
  input.closed = files.points(options.closed);
  const mvs::SurfaceFile &surface = files.file(options.surface);
  if (!options.label_array.empty()) input.labels = labels_of(surface, options.label_array);
  if (!options.thickness_array.empty()) {
    const double metre = metres(surface.info().unit);
    input.thickness = array_values(surface, options.thickness_array, MVS_SURFACE_PLACE_POINT);
    for (double &value : input.thickness) value *= metre;
  }
  if (options.thickness == 0 && !known.thickness.empty()) {
    with_known.build.thickness = known.thickness[0];
  }
  if (options.edge_error == 0 && !known.edge_error.empty()) {
    with_known.build.edge_error = known.edge_error[0];
  }
  if (options.edge_lost == 0 && !known.edge_lost.empty()) {
    with_known.build.edge_lost = known.edge_lost[0];
  }
  if (options.thickness_error == 0 && !known.thickness_error.empty()) {
    with_known.build.thickness_error = known.thickness_error[0];
  }
  if (options.leaflet.empty() && !known.tissue.empty()) {
    with_known.build.leaflet_law = law_of_finding(known.tissue[0], options.with);
  }
  return input;
}

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
void warn_of_contradictions(const std::vector<mvs::BuildFinding> &findings) {
  for (const mvs::BuildFinding &finding : findings) {
    const bool of_input = finding.name == "annulus" || finding.name == "commissures" ||
                          finding.name == "anterior" || finding.name == "closed_fit";
    if (!of_input || finding.confidence > least_confidence) continue;
    std::fprintf(stderr, "mvs: warning: %s, %.0f %% sure: %s\n", finding.name.c_str(),
                 100 * finding.confidence, finding.sentence.c_str());
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
  options.build.leaflet_law = law_of(options.leaflet);
  const Input input = read_input(given, options);
  warn_of_whole_valve(options.surface);
  const std::string name = std::filesystem::path(options.surface).stem().string();
  Progress progress(console);
  mvs_sim_desc how = {};
  how.progress = &Progress::callback;
  how.user = &progress;
  mvs::Simulator sim = make_sim(how);
  const std::vector<mvs::BuildFinding> findings =
      mvs::build_valve(sim, desc_of(input, options, name), options.build);
  warn_of_contradictions(findings);
  const mvs::Snapshot valve = sim.snapshot();
  valve.save(options.out);
  const std::string path = findings_path(options);
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
}

void add_range_options(CLI::App &command, ImportOptions &options) {
  command
      .add_option(
          "--edge-error", options.edge_error,
          "how far the free edge may lie farther out or in, mm: widens the interval of leaks "
          "[0]")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--edge-lost", options.edge_lost,
                  "tissue that may be missing at the free edge, mm: widens the interval of leaks "
                  "[half of the mean depth of its filled notches]")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--thickness-error", options.thickness_error,
                  "by how much the leaflets may be thicker or thinner, mm: widens the interval of "
                  "leaks [0]")
      ->check(CLI::PositiveNumber);
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
                      "the same leaflets closed: chords get lengths with which the valve closes to "
                      "them");
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
      ->check(CLI::PositiveNumber)
      ->excludes(array);
  command->add_option("--edge", options->edge, "sides of the new triangles, mm [1,000 vertices]")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--coaptation-length", options->coaptation_length,
                   "overlap in the middle for which rest lengths are chosen, mm [8]")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--chord-slack", options->build.chord_factor,
                   "factor on the rest length of every chord [1]")
      ->check(CLI::PositiveNumber);
  command->add_option("--chords", options->build.chords, "chord segments, about [100]")
      ->check(CLI::PositiveNumber);
  add_range_options(*command, *options);
  add_law_option(*command, options->leaflet, "membrane; with --closed the nearest one");
  command->add_option("--with", options->with,
                      "findings of an earlier import, edited: what is given, guessed or assumed in "
                      "them is used");
  command->add_option("--findings", options->findings_out,
                      "file for the findings [VALVE.import.json beside the output]");
  add_progress_flag(*command, console);
}

}  // namespace cli
