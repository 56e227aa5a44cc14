// `mvs compare`: how far two valves are apart.
#include <cmath>
#include <memory>

#include "commands.h"

namespace cli {
namespace {

struct Distances {
  double node_rms, node_max, surface_rms, surface_max;  // m; NaN: the meshes do not match
};

Json mm(double metres) {
  return std::isfinite(metres) ? Json(metres * 1e3) : Json();
}

Json distances_json(const Distances &d) {
  return {{"node_rms_mm", mm(d.node_rms)},
          {"node_max_mm", mm(d.node_max)},
          {"surface_rms_mm", mm(d.surface_rms)},
          {"surface_max_mm", mm(d.surface_max)}};
}

std::string row(const char *what, double rms, double max) {
  if (!std::isfinite(rms)) return text("  %-28sthe meshes do not match\n", what);
  return text("  %-28s%8.3f  %8.3f\n", what, rms * 1e3, max * 1e3);
}

Json rotation_json(const mvs_comparison &c) {
  const double *r = c.registration;
  return {{r[0], r[1], r[2]}, {r[4], r[5], r[6]}, {r[8], r[9], r[10]}};
}

void run(const std::string &a, const std::string &b, const Console &console) {
  const mvs_comparison c = load(a).compare(load(b));
  const Distances lie = {c.node_rms, c.node_max, c.surface_rms, c.surface_max};
  const Distances moved = {c.node_rms_registered, c.node_max_registered, c.surface_rms_registered,
                           c.surface_max_registered};
  Json registered = distances_json(moved);
  registered["rotation"] = rotation_json(c);
  registered["translation_mm"] = {mm(c.registration[3]), mm(c.registration[7]),
                                  mm(c.registration[11])};
  const Json object = {{"a", a},
                       {"b", b},
                       {"same_mesh", c.same_mesh != 0},
                       {"as_they_lie", distances_json(lie)},
                       {"registered", registered}};
  print(console, object,
        text("%s to %s, mm                RMS       max\n", a.c_str(), b.c_str()) +
            row("Node to node, as they lie", lie.node_rms, lie.node_max) +
            row("Surfaces, as they lie", lie.surface_rms, lie.surface_max) +
            row("Node to node, registered", moved.node_rms, moved.node_max) +
            row("Surfaces, registered", moved.surface_rms, moved.surface_max));
}

}  // namespace

void add_compare(CLI::App &app, Console &console) {
  auto files = std::make_shared<std::pair<std::string, std::string>>();
  CLI::App *command =
      add_command(app, console, "compare", "distance of two valves, before and after registration");
  command->add_option("a", files->first, "a valve, .obj or .h5")->required();
  command->add_option("b", files->second, "the valve to compare it with, .obj or .h5")->required();
  command->callback([files, &console] { run(files->first, files->second, console); });
}

}  // namespace cli
