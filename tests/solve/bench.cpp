// Fixtures of tests/solve/bench.h: meshing, finite differences, settling.
#include "tests/solve/bench.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

#include <mvs/sim.h>

#include "energy/total_energy.h"
#include "solve/dynamic/time_step.h"

namespace mvs::core::test {
namespace {

void complete_sheet(Valve &valve) {
  if (valve.leaflets.empty()) valve.leaflets.resize(1);
  valve.triangle_leaflet.resize(valve.triangles.size(), 0u);
  valve.open = valve.loaded = valve.rest;
  for (const uint32_t l : valve.triangle_leaflet) {
    valve.triangle_thickness.push_back(valve.leaflets[l].thickness);
  }
  if (valve.triangle_fibre.empty()) {
    for (const Tri &t : valve.triangles) {
      valve.triangle_fibre.push_back(Vec3((valve.rest[t[1]] - valve.rest[t[0]]).normalized()));
    }
  }
  for (Chord &c : valve.chords) {
    if (c.rest_length == 0) c.rest_length = (valve.rest[c.b] - valve.rest[c.a]).norm();
  }
}

// Rings of 6 r nodes around node 0.
Model clamped_rings(uint32_t rings, const std::function<void(Valve &)> &change,
                    const std::function<Vec3(uint32_t r, uint32_t k)> &place) {
  Valve valve;
  valve.rest.push_back(Vec3::Zero());
  for (uint32_t r = 1; r <= rings; ++r) {
    for (uint32_t k = 0; k < 6 * r; ++k) valve.rest.push_back(place(r, k));
  }
  const auto node = [](uint32_t r, uint32_t k) {
    return r == 0 ? 0 : 1 + 3 * r * (r - 1) + k % (6 * r);
  };
  for (uint32_t r = 1; r <= rings; ++r) {
    for (uint32_t sector = 0; sector < 6; ++sector) {
      for (uint32_t k = 0; k < r; ++k) {
        const uint32_t outer = sector * r + k, inner = sector * (r - 1) + k;
        valve.triangles.push_back({node(r - 1, inner), node(r, outer), node(r, outer + 1)});
        if (k + 1 == r) continue;
        valve.triangles.push_back({node(r - 1, inner), node(r, outer + 1), node(r - 1, inner + 1)});
      }
    }
  }
  change(valve);
  std::vector<uint32_t> rim;
  for (uint32_t k = 0; k < 6 * rings; ++k) rim.push_back(node(rings, k));
  return model_of_sheet(std::move(valve), rim);
}

}  // namespace

std::vector<Cells> reference_table(const std::string &file) {
  const char *folder = std::getenv("MVS_TEST_DATA");
  const std::string data = folder != nullptr ? folder : MVS_SOURCE_DIR "/../shared/data";
  std::ifstream in(data + "/verification/" + file);
  std::vector<Cells> rows;
  std::string line, cell;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    while (std::getline(cells, cell, ',')) rows.back().push_back(cell);
  }
  if (rows.empty()) {
    std::cerr << "skipped: no " << file << " in MVS_TEST_DATA or ../shared/data\n";
  }
  return rows;
}

Positions Random::vectors(size_t count, double size) {
  Positions result;
  for (size_t i = 0; i < count; ++i) result.push_back(vector(size));
  return result;
}

Model model_of_sheet(Valve valve, const std::vector<uint32_t> &fixed) {
  Model model;
  complete_sheet(valve);
  const size_t n = valve.rest.size();
  model.topology = make_topology(valve);
  model.topology.fixed.assign(n, 0);
  for (const uint32_t node : fixed) model.topology.fixed[node] = 1;
  for (const Edge &e : model.topology.edges) {
    model.rest_length.push_back((valve.rest[e[1]] - valve.rest[e[0]]).norm());
  }
  model.vertex_area.assign(n, 0);
  model.node_mass.assign(n, 0);
  for (size_t k = 0; k < valve.triangles.size(); ++k) {
    const Tri &t = valve.triangles[k];
    const Vec3 a = valve.rest[t[1]] - valve.rest[t[0]], b = valve.rest[t[2]] - valve.rest[t[0]];
    model.rest_area.push_back(0.5 * a.cross(b).norm());
    const double mass = valve.density * valve.triangle_thickness[k] * model.rest_area[k];
    for (const uint32_t node : t) {
      model.vertex_area[node] += model.rest_area[k] / 3;
      model.node_mass[node] += mass / 3;
    }
  }
  for (const Chord &c : valve.chords) {
    for (const uint32_t node : {c.a, c.b}) {
      model.node_mass[node] += 0.5 * valve.density * c.area * c.rest_length;
    }
  }
  model.valve = std::move(valve);
  return model;
}

uint32_t add_grid(Valve &valve, uint32_t nu, uint32_t nv,
                  const std::function<Vec3(double u, double v)> &place) {
  const auto first = static_cast<uint32_t>(valve.rest.size());
  for (uint32_t j = 0; j <= nv; ++j) {
    for (uint32_t i = 0; i <= nu; ++i) valve.rest.push_back(place(i, j));
  }
  for (uint32_t j = 0; j < nv; ++j) {
    for (uint32_t i = 0; i < nu; ++i) {
      const uint32_t a = first + j * (nu + 1) + i, b = a + 1, c = a + nu + 1, d = c + 1;
      valve.triangles.push_back({a, b, c});
      valve.triangles.push_back({b, d, c});
    }
  }
  return first;
}

std::vector<uint32_t> rim_of_grid(uint32_t first, uint32_t nu, uint32_t nv) {
  std::vector<uint32_t> rim;
  for (uint32_t j = 0; j <= nv; ++j) {
    for (uint32_t i = 0; i <= nu; ++i) {
      const bool inside = i > 0 && i < nu && j > 0 && j < nv;
      if (!inside) rim.push_back(first + j * (nu + 1) + i);
    }
  }
  return rim;
}

Model clamped_hexagon(uint32_t rings, double radius, const std::function<void(Valve &)> &change) {
  return clamped_rings(rings, change, [=](uint32_t r, uint32_t k) -> Vec3 {
    const auto corner = [&](uint32_t s) {
      return Vec3(std::cos(pi / 3 * s), std::sin(pi / 3 * s), 0);
    };
    const double along = static_cast<double>(k % r) / r;
    return radius * r / rings * ((1 - along) * corner(k / r) + along * corner(k / r + 1));
  });
}

Model clamped_disc(uint32_t rings, double radius, const std::function<void(Valve &)> &change) {
  return clamped_rings(rings, change, [=](uint32_t r, uint32_t k) -> Vec3 {
    const double angle = 2 * pi * k / (6 * r), distance = radius * r / rings;
    return {distance * std::cos(angle), distance * std::sin(angle), 0};
  });
}

Plates two_plates(uint32_t cells, double side, double gap, bool fixed_rims,
                  const std::function<void(Valve &)> &change) {
  Valve valve;
  const uint32_t more = cells + 1;
  add_grid(valve, cells, cells, [&](double u, double v) -> Vec3 {
    return {side * u / cells, side * v / cells, 0};
  });
  const uint32_t upper = add_grid(valve, more, more, [&](double u, double v) -> Vec3 {
    return {side * v / more, side * u / more, gap};
  });
  change(valve);
  std::vector<uint32_t> fixed;
  if (fixed_rims) {
    fixed = rim_of_grid(0, cells, cells);
    const std::vector<uint32_t> rim = rim_of_grid(upper, more, more);
    fixed.insert(fixed.end(), rim.begin(), rim.end());
  }
  return {model_of_sheet(std::move(valve), fixed), upper, cells, more};
}

Positions Plates::at(double gap) const {
  Positions x = model.valve.rest;
  for (size_t i = upper; i < x.size(); ++i) x[i].z() = gap;
  return x;
}

Positions Motion::operator()(const Positions &x) const {
  Positions result;
  for (const Vec3 &p : x) result.push_back((*this)(p));
  return result;
}

Motion some_motion() {
  const Eigen::AngleAxisd turn(1.1, Vec3(0.3, -0.7, 0.5).normalized());
  return {turn.toRotationMatrix(), {0.12, -0.05, 0.31}};
}

Positions differences(const std::function<double(const Positions &)> &energy, Positions x,
                      double h) {
  Positions g(x.size());
  for (size_t i = 0; i < x.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const double middle = x[i][k];
      x[i][k] = middle + h;
      const double after = energy(x);
      x[i][k] = middle - h;
      g[i][k] = (after - energy(x)) / (2 * h);
      x[i][k] = middle;
    }
  }
  return g;
}

Eigen::MatrixXd differences(const Gradient &gradient, Positions x, double h) {
  const auto n = static_cast<Eigen::Index>(3 * x.size());
  Eigen::MatrixXd result(n, n);
  for (Eigen::Index c = 0; c < n; ++c) {
    double &moving = x[static_cast<size_t>(c / 3)][c % 3];
    const double middle = moving;
    moving = middle + h;
    const Eigen::VectorXd after = flat(gradient(x));
    moving = middle - h;
    result.col(c) = (after - flat(gradient(x))) / (2 * h);
    moving = middle;
  }
  return result;
}

Eigen::MatrixXd dense(const HessianAssembler &system) {
  const auto n = static_cast<Eigen::Index>(3 * system.row_of.size());
  const BlockMatrix &m = system.matrix;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
  for (uint32_t c = 0; c < m.size(); ++c) {
    for (uint32_t slot = m.start[c]; slot < m.start[c + 1]; ++slot) {
      const Eigen::Index i = 3 * system.node_of[m.row[slot]], j = 3 * system.node_of[c];
      result.block<3, 3>(i, j) = m.value[slot];
      result.block<3, 3>(j, i) = m.value[slot].transpose();
    }
  }
  return result;
}

Eigen::VectorXd flat(const Positions &x) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(3 * x.size()));
  for (size_t i = 0; i < x.size(); ++i) result.segment<3>(static_cast<Eigen::Index>(3 * i)) = x[i];
  return result;
}

double largest(const Positions &x) {
  double most = 0;
  for (const Vec3 &p : x) most = std::max(most, p.norm());
  return most;
}

double farthest(const Positions &x, const Positions &y) {
  double most = 0;
  for (size_t i = 0; i < x.size(); ++i) most = std::max(most, (x[i] - y[i]).norm());
  return most;
}

double total_energy(const Model &model, const State &state) {
  TotalEnergy total_energy(model);
  Profile profile{};
  Positions g;
  total_energy.set_pressure(state.load.pressure);
  total_energy.prepare(state.x, state.x, 0, profile);
  return total_energy.gradient(state.x, g, profile) + kinetic_energy(model, state.v);
}

Settled settle(const Model &model, const State &from, const SolveOptions &options) {
  Settled result{from, {}};
  Solver solver(Backend::fastest);
  result.stats = solver.settle(model, result.state, options, {});
  return result;
}

Settled settle(const Model &model, double pressure, double fraction, const SolveOptions &options) {
  State state = initial_state(model);
  state.load = {pressure, fraction};
  return settle(model, state, options);
}

State closed(const Model &model) {
  const Settled settled = settle(model, MVS_SYSTOLE_PA, 1);
  REQUIRE(settled.stats.converged);
  return settled.state;
}

}  // namespace mvs::core::test
