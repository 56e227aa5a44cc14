// `mvs compare`: node and surface distances of two valves, before and after rigid registration.
#include <cmath>

#include "commands/commands.h"

namespace cli {
namespace {

struct CompareOptions {
  std::string a, b;
};

struct Distances {
  double node_rms, node_max, surface_rms, surface_max;  // m; node figures NaN for different meshes
};

Json distances_json(const Distances &d) {
  return {{"node_rms_mm", number_json(d.node_rms, 1e3)},
          {"node_max_mm", number_json(d.node_max, 1e3)},
          {"surface_rms_mm", number_json(d.surface_rms, 1e3)},
          {"surface_max_mm", number_json(d.surface_max, 1e3)}};
}

std::string distance_text(const char *label, double rms, double max) {
  if (!std::isfinite(rms)) return text("  %-28sthe meshes do not match\n", label);
  return text("  %-28s%8.3f  %8.3f\n", label, rms * 1e3, max * 1e3);
}

void run_compare(const CompareOptions &options, const Console &console) {
  const mvs_comparison c = load(options.a).compare(load(options.b));
  const Distances plain = {c.node_rms, c.node_max, c.surface_rms, c.surface_max};
  const Distances moved = {c.node_rms_registered, c.node_max_registered, c.surface_rms_registered,
                           c.surface_max_registered};
  const double *r = c.registration;  // rows of [R | t]
  Json registered = distances_json(moved);
  registered["rotation"] = {{r[0], r[1], r[2]}, {r[4], r[5], r[6]}, {r[8], r[9], r[10]}};
  registered["translation_mm"] = {number_json(r[3], 1e3), number_json(r[7], 1e3),
                                  number_json(r[11], 1e3)};
  print(console,
        {{"a", options.a},
         {"b", options.b},
         {"same_mesh", c.same_mesh != 0},
         {"as_they_lie", distances_json(plain)},
         {"registered", registered}},
        text("%s to %s, mm                RMS       max\n", options.a.c_str(), options.b.c_str()) +
            distance_text("Node to node, as they lie", plain.node_rms, plain.node_max) +
            distance_text("Surfaces, as they lie", plain.surface_rms, plain.surface_max) +
            distance_text("Node to node, registered", moved.node_rms, moved.node_max) +
            distance_text("Surfaces, registered", moved.surface_rms, moved.surface_max));
}

}  // namespace

void add_compare(CLI::App &app, Console &console) {
  const auto [command, options] = add_command<CompareOptions>(
      app, console, "compare", "distances of two valves, before and after registration",
      run_compare);
  command->add_option("a", options->a, "a valve, .obj or .h5")->required();
  command->add_option("b", options->b, "the valve to compare it with, .obj or .h5")->required();
}

}  // namespace cli
