// make_model: checks a valve, fills in defaults, derives topology, rest lengths, areas and lumped
// masses.
#include "model/model.h"

#include <Eigen/Geometry>
#include <atomic>
#include <numeric>

#include "base/error.h"
#include "model/checks/check.h"
#include "model/complete.h"
#include "model/sides.h"

namespace mvs::core {
namespace {

void derive_lengths_and_areas(Model &model) {
  const Valve &valve = model.valve;
  for (const Edge &edge : model.topology.edges) {
    model.rest_length.push_back((valve.rest[edge[1]] - valve.rest[edge[0]]).norm());
  }
  model.vertex_area.assign(valve.rest.size(), 0);
  for (const Tri &triangle : valve.triangles) {
    const double area = triangle_area(valve.rest, triangle);
    model.rest_area.push_back(area);
    for (const uint32_t node : triangle) model.vertex_area[node] += area / 3;
  }
}

void derive_mass(Model &model) {
  const Valve &valve = model.valve;
  model.node_mass.assign(valve.rest.size(), 0);
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const double mass = valve.density * valve.triangle_thickness[t] * model.rest_area[t];
    for (const uint32_t node : valve.triangles[t]) model.node_mass[node] += mass / 3;
  }
  for (const Chord &chord : valve.chords) {
    const double mass = valve.density * chord.area * chord.rest_length;
    model.node_mass[chord.a] += mass / 2;
    model.node_mass[chord.b] += mass / 2;
  }
}

// Derives topology, lengths and areas, or takes those of a model with the same mesh (may be null).
void derive_geometry(Model &model, const Model *same) {
  if (same) {
    model.topology = same->topology;
    model.rest_length = same->rest_length;
    model.rest_area = same->rest_area;
    model.vertex_area = same->vertex_area;
    model.family = same->family;
  } else {
    model.topology = make_topology(model.valve);
    derive_lengths_and_areas(model);
    model.family = std::make_shared<MeshFamily>();
  }
  model.family->add_model();
}

}  // namespace

size_t sheet_vertices(const Model &model) {
  size_t count = 0;
  for (uint32_t n = 0; n < model.node_count(); ++n) {
    count += !model.topology.node_triangles[n].empty();
  }
  return count;
}

double mean_edge(const Model &model) {
  const std::vector<double> &length = model.rest_length;
  return std::accumulate(length.begin(), length.end(), 0.0) / static_cast<double>(length.size());
}

ModelPtr make_model(Valve valve, const Model *parent) {
  const Model *same = parent && has_mesh_of(valve, *parent) ? parent : nullptr;
  const std::vector<Fault> faults = same ? find_faults_beside_mesh(valve) : find_faults(valve);
  if (!faults.empty()) {
    fail(MVS_E_OP, faults.front().part, "%s", faults.front().sentence.c_str());
  }
  complete(valve);
  static std::atomic<uint64_t> models{0};
  auto model = std::make_shared<Model>();
  model->serial = ++models;
  model->valve = std::move(valve);
  derive_geometry(*model, same);
  derive_mass(*model);
  if (parent) share(*model, *parent);
  return model;
}

State initial_state(const Model &model) {
  State state;
  state.x = model.valve.rest;
  state.v.assign(state.x.size(), Vec3::Zero());
  return state;
}

}  // namespace mvs::core
