// Flattening of a leaflet: least squares conformal map (Levy et al., SIGGRAPH 2002), followed by
// local/global as-rigid-as-possible iterations (Liu et al., A Local/Global Approach to Mesh
// Parameterization, SGP 2008). A leaflet at rest is close to a developable cone, so the distortion
// is small.
#include "surgery/leaflet/flat.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <complex>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/math.h"
#include "measure/annulus/frame.h"

namespace mvs::core {
namespace {

using Complex = std::complex<double>;
using Plane = Eigen::VectorXcd;

// A triangle of the piece: its rows, its isolated planar shape, the cotangents of its angles.
struct Facet {
  std::array<int, 3> row;
  std::array<Complex, 3> shape;
  std::array<double, 3> cotangent;
};

// Half the angular range of a piece about the axis; larger than the sector of any leaflet.
constexpr double half_sector = 100.0 / 180 * std::numbers::pi;

// Returns the triangles of a leaflet connected to `triangle` within that sector.
std::vector<uint32_t> piece_around(const Model &model, uint32_t triangle) {
  const Valve &valve = model.valve;
  const Frame frame = valve_frame(model, valve.rest);
  const auto angle = [&](uint32_t t) {
    Vec3 middle = Vec3::Zero();
    for (const uint32_t node : valve.triangles[t]) middle += frame.local(valve.rest[node]) / 3;
    return math::atan2(middle[1], middle[0]);
  };
  const double here = angle(triangle);
  std::vector<uint8_t> seen(valve.triangles.size(), 0);
  return connected_triangles(model.topology, triangle, seen, [&](uint32_t t) {
    return valve.triangle_leaflet[t] == valve.triangle_leaflet[triangle] &&
           std::abs(std::remainder(angle(t) - here, 2 * std::numbers::pi)) <= half_sector;
  });
}

// Returns the row of each node of a piece, in the order of the nodes; -1 for other nodes.
std::vector<int> rows_of_piece(const Valve &valve, const std::vector<uint32_t> &piece, int &count) {
  std::vector<int> row(valve.rest.size(), -1);
  for (const uint32_t t : piece) {
    for (const uint32_t node : valve.triangles[t]) row[node] = 0;
  }
  count = 0;
  for (int &r : row) {
    if (r == 0) r = count++;
  }
  return row;
}

Facet facet_of(const Valve &valve, const Tri &nodes, const std::vector<int> &row) {
  const Vec3 a = valve.rest[nodes[1]] - valve.rest[nodes[0]];
  const Vec3 b = valve.rest[nodes[2]] - valve.rest[nodes[0]];
  const double length = a.norm(), height = a.cross(b).norm() / length;
  Facet facet{
      {row[nodes[0]], row[nodes[1]], row[nodes[2]]}, {0, length, {a.dot(b) / length, height}}, {}};
  for (int k = 0; k < 3; ++k) {
    const Complex p = facet.shape[(k + 1) % 3] - facet.shape[k];
    const Complex q = facet.shape[(k + 2) % 3] - facet.shape[k];
    const Complex turn = std::conj(p) * q;
    facet.cotangent[k] = turn.real() / turn.imag();
  }
  return facet;
}

// Conformal map with row 0 at the origin and the farthest node at its distance; the other rows by
// least squares.
Plane conformal(const std::vector<Facet> &facets, int count, int pin, double away) {
  const auto place = [&](int row) { return row < pin ? row - 1 : row - 2; };
  std::vector<Eigen::Triplet<Complex>> entries;
  Plane right = Plane::Zero(static_cast<Eigen::Index>(facets.size()));
  for (size_t f = 0; f < facets.size(); ++f) {
    const auto &[row, shape, cotangent] = facets[f];
    const double area = 0.5 * shape[1].real() * shape[2].imag();
    for (int k = 0; k < 3; ++k) {
      const Complex w = (shape[(k + 2) % 3] - shape[(k + 1) % 3]) / std::sqrt(area);
      if (row[k] == pin) right[static_cast<Eigen::Index>(f)] -= w * away;
      if (row[k] == pin || row[k] == 0) continue;
      entries.emplace_back(static_cast<int>(f), place(row[k]), w);
    }
  }
  Eigen::SparseMatrix<Complex> m(static_cast<int>(facets.size()), count - 2);
  m.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseMatrix<Complex> normal = m.adjoint() * m;
  const Plane free =
      Eigen::SimplicialLDLT<Eigen::SparseMatrix<Complex>>(normal).solve(m.adjoint() * right);
  Plane all(count);
  for (int r = 0; r < count; ++r) all[r] = r == 0 ? 0 : r == pin ? away : free[place(r)];
  return all;
}

// Cotangent Laplacian without row 0.
Eigen::SparseMatrix<double> laplacian(const std::vector<Facet> &facets, int count) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Facet &f : facets) {
    for (int k = 0; k < 3; ++k) {
      const int i = f.row[(k + 1) % 3] - 1, j = f.row[(k + 2) % 3] - 1;
      if (i >= 0) entries.emplace_back(i, i, f.cotangent[k]);
      if (j >= 0) entries.emplace_back(j, j, f.cotangent[k]);
      if (i < 0 || j < 0) continue;
      entries.emplace_back(i, j, -f.cotangent[k]);
      entries.emplace_back(j, i, -f.cotangent[k]);
    }
  }
  Eigen::SparseMatrix<double> matrix(count - 1, count - 1);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// Right-hand side of the global step: each triangle has its best rotation for the present
// positions.
Plane turned_shapes(const std::vector<Facet> &facets, const Plane &at) {
  Plane right = Plane::Zero(at.size());
  for (const Facet &f : facets) {
    Complex turn = 0;
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      turn += f.cotangent[k] * (at[f.row[a]] - at[f.row[b]]) * std::conj(f.shape[a] - f.shape[b]);
    }
    const double length = math::hypot(turn.real(), turn.imag());
    turn = length > 0 ? turn / length : 1;
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      const Complex side = f.cotangent[k] * turn * (f.shape[a] - f.shape[b]);
      right[f.row[a]] += side;
      right[f.row[b]] -= side;
    }
  }
  return right;
}

// Local/global iterations; twenty bring a leaflet, which is nearly a cone, to well below 0.01 mm of
// the limit.
void make_rigid(const std::vector<Facet> &facets, Plane &at) {
  const int count = static_cast<int>(at.size());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(laplacian(facets, count));
  for (int round = 0; round < 20; ++round) {
    const Plane right = turned_shapes(facets, at).tail(count - 1);
    const Eigen::VectorXd re = solver.solve(right.real()), im = solver.solve(right.imag());
    at[0] = 0;
    for (int r = 1; r < count; ++r) at[r] = {re[r - 1], im[r - 1]};
  }
}

}  // namespace

bool Flat::has(const Valve &valve, uint32_t triangle) const {
  const Tri &t = valve.triangles[triangle];
  return valve.triangle_leaflet[triangle] == leaflet && has(t[0]) && has(t[1]) && has(t[2]);
}

Vec2 Flat::point(const Valve &valve, const SheetPoint &p) const {
  Vec2 sum = Vec2::Zero();
  for (int k = 0; k < 3; ++k) sum += p.weight[k] * at[valve.triangles[p.triangle][k]];
  return sum;
}

Flat flatten(const Model &model, uint32_t triangle) {
  const Valve &valve = model.valve;
  const std::vector<uint32_t> piece = piece_around(model, triangle);
  int count = 0;
  const std::vector<int> row = rows_of_piece(valve, piece, count);
  std::vector<Facet> facets;
  facets.reserve(piece.size());
  for (const uint32_t t : piece) facets.push_back(facet_of(valve, valve.triangles[t], row));
  const Vec3 *first = nullptr;
  int pin = 0;
  double away = 0;
  for (size_t n = 0; n < row.size(); ++n) {
    if (row[n] < 0) continue;
    if (!first) first = &valve.rest[n];
    if ((valve.rest[n] - *first).norm() <= away) continue;
    away = (valve.rest[n] - *first).norm();
    pin = row[n];
  }
  Plane at = conformal(facets, count, pin, away);
  make_rigid(facets, at);
  Flat flat{std::vector<Vec2>(row.size(), Vec2::Constant(std::numeric_limits<double>::quiet_NaN())),
            valve.triangle_leaflet[triangle]};
  for (size_t n = 0; n < row.size(); ++n) {
    if (row[n] >= 0) flat.at[n] = {at[row[n]].real(), at[row[n]].imag()};
  }
  return flat;
}

double distance_to_segment(const Vec2 &p, const Vec2 &a, const Vec2 &b) {
  const Vec2 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double s = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (p - a - s * ab).norm();
}

}  // namespace mvs::core
