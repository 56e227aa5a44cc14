// Harmonic height by a graph Laplacian with weights 1 / length; angles about the valve axis.
#include "surgery/leaflet/sheet_map.h"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>

#include "base/math.h"
#include "measure/annulus/frame.h"
#include "model/seams.h"

namespace mvs::core {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

// Two nodes that are neighbours on the sheet or sutured to each other, with the weight of their
// connection.
struct Tie {
  Edge nodes;
  double weight;
};

// Boundary values: 0 on the annulus, 1 on the free edges; -1 elsewhere.
std::vector<double> boundary_heights(const Model &model, const std::vector<uint8_t> &sewn) {
  std::vector<double> height(model.node_count(), -1);
  for (const std::vector<uint32_t> &loop : model.topology.free_edges) {
    for (const uint32_t node : loop) {
      if (!sewn[node]) height[node] = 1;
    }
  }
  for (const uint32_t node : model.valve.annulus) height[node] = 0;
  return height;
}

// Solves sum over neighbours of (h - h_neighbour) / length = 0 at every inner node.
std::vector<double> harmonic_heights(const Model &model) {
  const Seams seams = find_seams(model);
  std::vector<Tie> ties;
  for (const uint32_t c : seams.sutures) {
    const Chord &suture = model.valve.chords[c];
    ties.push_back({{suture.a, suture.b}, 1 / suture.rest_length});
  }
  for (size_t e = 0; e < model.topology.edges.size(); ++e) {
    ties.push_back({model.topology.edges[e], 1 / model.rest_length[e]});
  }
  std::vector<double> height = boundary_heights(model, seams.inside);
  std::vector<int> row(height.size(), -1);
  int count = 0;
  for (uint32_t n = 0; n < height.size(); ++n) {
    if (height[n] < 0 && !model.topology.node_triangles[n].empty()) row[n] = count++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  for (const auto &[nodes, weight] : ties) {
    for (int side = 0; side < 2; ++side) {
      const int here = row[nodes[side]], there = row[nodes[1 - side]];
      if (here < 0) continue;
      entries.emplace_back(here, here, weight);
      if (there >= 0) {
        entries.emplace_back(here, there, -weight);
      } else {
        right[here] += weight * height[nodes[1 - side]];
      }
    }
  }
  Sparse matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd solution = Eigen::SimplicialLDLT<Sparse>(matrix).solve(right);
  for (size_t n = 0; n < height.size(); ++n) {
    if (row[n] >= 0) height[n] = solution[row[n]];
  }
  return height;
}

double wrapped(double angle) {
  return std::remainder(angle, 2 * std::numbers::pi);
}

}  // namespace

SheetMap::SheetMap(const Model &model) : height_(harmonic_heights(model)) {
  const std::vector<Vec3> &rest = model.valve.rest;
  const Frame frame = valve_frame(model, rest);
  std::vector<double> cc;
  for (const Vec3 &p : rest) {
    const Vec3 local = frame.local(p);
    angle_.push_back(math::atan2(local[1], local[0]));
    cc.push_back(local[1]);
  }
  ranges_.resize(model.valve.scallops.size());
  for (uint32_t s = 0; s < ranges_.size(); ++s) {
    Range &range = ranges_[s];
    Vec3 towards = Vec3::Zero();
    std::vector<uint32_t> nodes;
    for (size_t t = 0; t < model.valve.triangles.size(); ++t) {
      if (model.valve.triangle_scallop[t] != s) continue;
      for (const uint32_t node : model.valve.triangles[t]) {
        towards += Vec3(math::cos(angle_[node]), math::sin(angle_[node]), 0);
        nodes.push_back(node);
      }
    }
    range.middle = math::atan2(towards[1], towards[0]);
    double slope = 0;
    for (const uint32_t node : nodes) {
      const double a = wrapped(angle_[node] - range.middle);
      range.low = std::min(range.low, a);
      range.high = std::max(range.high, a);
      slope += a * cc[node];
    }
    range.turned = slope < 0;
  }
}

double SheetMap::angle(const Range &range, uint32_t node) const {
  const double a = wrapped(angle_[node] - range.middle);
  return (a - range.low) / std::max(range.high - range.low, 1e-9);
}

double SheetMap::along(uint32_t scallop, uint32_t node) const {
  const Range &range = ranges_[scallop];
  const double a = angle(range, node);
  return range.turned ? 1 - a : a;
}

}  // namespace mvs::core
