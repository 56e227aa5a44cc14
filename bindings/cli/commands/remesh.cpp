// `mvs remesh`: writes a finer or coarser mesh level of a valve.
#include "commands/commands.h"
#include "text/command_units.h"
#include "text/output_file.h"

namespace cli {
namespace {

struct RemeshOptions {
  std::string in, out;
  uint32_t refine = 0, vertices = 0;
  double edge = 0;  // mm
};

Json coarsening_json(const mvs_coarsening &made) {
  return {{"chords_moved", made.chords_moved},        {"chords_merged", made.chords_merged},
          {"chord_move_mm", made.chord_move * 1e3},   {"surface_max_mm", made.surface_max * 1e3},
          {"surface_rms_mm", made.surface_rms * 1e3}, {"worst_quality", made.worst_quality}};
}

std::string coarsening_text(const mvs_coarsening &made) {
  return text(
      "\n  old vertices lie %.3f mm (RMS) and at most %.3f mm from the coarse surface\n"
      "  %u chordae end at another vertex, at most %.2f mm away; %u merged into others\n"
      "  worst triangle %.2f (1: equilateral, 0: flat)",
      made.surface_rms * 1e3, made.surface_max * 1e3, made.chords_moved, made.chord_move * 1e3,
      made.chords_merged, made.worst_quality);
}

void run_remesh(const RemeshOptions &options, const Console &console) {
  demand_writable_valve(options.out);
  mvs::Simulator sim = make_sim();
  sim.load_file(options.in);
  const Size before = size_of(sim.snapshot());
  for (uint32_t level = 0; level < options.refine; ++level) mvs::refine(sim);
  mvs_coarsening made = {};
  if (options.refine == 0) {
    made = with_command_units([&] {
      return mvs::coarsen(sim, {0, options.vertices, options.edge * 1e-3});
    });
  }
  const mvs::Snapshot valve = sim.snapshot();
  valve.save(options.out);
  const Size after = size_of(valve);
  Json object = {
      {"from", options.in},         {"to", options.out},    {"vertices_before", before.vertices},
      {"vertices", after.vertices}, {"faces", after.faces}, {"chords", after.chords},
      {"hash", hash_of(valve)}};
  if (options.refine == 0) object["coarsening"] = coarsening_json(made);
  print(console, object,
        text("%s: %zu leaflet vertices, %zu triangles, %zu chordae; %s has %zu vertices",
             options.out.c_str(), after.vertices, after.faces, after.chords, options.in.c_str(),
             before.vertices) +
            (options.refine == 0 ? coarsening_text(made) : ""));
}

}  // namespace

void add_remesh(CLI::App &app, Console &console) {
  const auto [command, options] = add_command<RemeshOptions>(
      app, console, "remesh", "make a finer or coarser mesh of the same valve", run_remesh);
  command->add_option("file", options->in, "valve to read, .obj or .h5")->required();
  command->add_option("-o,--output", options->out, "file to write, .obj, .h5, .vtp or .vtm")
      ->required();
  CLI::Option_group *how = command->add_option_group("how", "exactly one of these");
  how->add_option("--refine", options->refine, "split each triangle into four, this many times")
      ->check(CLI::Range(1, 8));
  how->add_option("--vertices", options->vertices, "coarsen to this many leaflet vertices")
      ->check(positive());
  how->add_option("--edge", options->edge, "coarsen to edges of about this mean length, mm")
      ->check(positive());
  how->require_option(1);
}

}  // namespace cli
