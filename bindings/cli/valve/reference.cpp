#include "valve/reference.h"

#include <algorithm>
#include <cmath>

namespace cli {
namespace {

struct Distance {
  const char *key;
  const char *label;
  double mvs_comparison::*value;
};

using C = mvs_comparison;
constexpr Distance distances[] = {
    {"node_rms_mm", "Node to node, RMS", &C::node_rms},
    {"node_max_mm", "Node to node, max", &C::node_max},
    {"surface_rms_mm", "Surfaces, RMS", &C::surface_rms},
    {"surface_max_mm", "Surfaces, max", &C::surface_max},
    {"node_rms_registered_mm", "Node to node registered, RMS", &C::node_rms_registered},
    {"node_max_registered_mm", "Node to node registered, max", &C::node_max_registered},
    {"surface_rms_registered_mm", "Surfaces registered, RMS", &C::surface_rms_registered},
    {"surface_max_registered_mm", "Surfaces registered, max", &C::surface_max_registered},
};

// The minimum and the maximum over the members, m.
std::pair<double, double> range_of(const Errors &errors, const Distance &distance) {
  double least = errors.at_rest[0].*distance.value, most = least;
  for (const mvs_comparison &c : errors.at_rest) {
    least = std::min(least, c.*distance.value);
    most = std::max(most, c.*distance.value);
  }
  return {least, most};
}

}  // namespace

Errors errors_from(const std::string &file, const mvs::Snapshot &reference,
                   const mvs::Snapshot &closed, const Ensemble *ensemble) {
  Errors errors = {file, closed.compare(reference), {}};
  const uint32_t members = ensemble ? ensemble->summary().members : 0;
  for (uint32_t k = 0; k < members; ++k) {
    if (!ensemble->member(k).converged) continue;
    errors.at_rest.push_back(ensemble->snapshot(k).compare(reference));
  }
  return errors;
}

Json errors_json(const Errors &errors) {
  Json json = {{"file", errors.file}, {"same_mesh", errors.plain.same_mesh != 0}};
  for (const Distance &distance : distances)
    json[distance.key] = number_json(errors.plain.*distance.value, 1e3);
  if (errors.at_rest.empty()) return json;
  Json over = {{"members", errors.at_rest.size()}};
  for (const Distance &distance : distances) {
    const auto [least, most] = range_of(errors, distance);
    over[distance.key] = {{"min", number_json(least, 1e3)}, {"max", number_json(most, 1e3)}};
  }
  json["ensemble"] = over;
  return json;
}

std::string errors_text(const Errors &errors) {
  std::string table = text("  Distance from %s, mm\n", errors.file.c_str());
  for (const Distance &distance : distances) {
    const double value = errors.plain.*distance.value;
    if (!std::isfinite(value)) continue;  // node to node of different meshes
    table += text("  %-30s%10.3f", distance.label, value * 1e3);
    if (!errors.at_rest.empty()) {
      const auto [least, most] = range_of(errors, distance);
      table += text("  (%.3f to %.3f over %zu members at rest)", least * 1e3, most * 1e3,
                    errors.at_rest.size());
    }
    table += '\n';
  }
  return table;
}

}  // namespace cli
