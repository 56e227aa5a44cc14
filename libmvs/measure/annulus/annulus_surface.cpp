// Linear finite elements for the Laplace equation on concentric rings.
#include "measure/annulus/annulus_surface.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mvs::core {
namespace {

constexpr size_t rings = 24;  // gives the area of a saddle to 1e-4

using Triplets = std::vector<Eigen::Triplet<double>>;

// Calls visit(corners, share) for each triangle between two rings. A quadrilateral is the mean of
// its two triangulations, so that a mirrored annulus has the mirrored surface.
template <typename Visit>
void for_each_element(size_t sides, Visit visit) {
  using Corner = std::array<size_t, 2>;  // ring, place
  for (size_t k = 0; k < sides; ++k) {
    visit(std::array<Corner, 3>{{{0, 0}, {1, k}, {1, k + 1}}}, 1.0);
    for (size_t r = 1; r < rings; ++r) {
      const Corner a = {r, k}, b = {r + 1, k}, c = {r + 1, k + 1}, d = {r, k + 1};
      visit(std::array<Corner, 3>{a, b, c}, 0.5);
      visit(std::array<Corner, 3>{a, c, d}, 0.5);
      visit(std::array<Corner, 3>{a, b, d}, 0.5);
      visit(std::array<Corner, 3>{b, c, d}, 0.5);
    }
  }
}

}  // namespace

AnnulusSurface::AnnulusSurface(const Frame &frame, const std::vector<Vec3> &rim)
    : rim_(frame.local(rim)) {
  double turn = 0;
  for (size_t k = 0; k < sides(); ++k) turn += cross_in_plane(rim_[k], rim_[(k + 1) % sides()]);
  if (turn < 0) std::reverse(rim_.begin(), rim_.end());
  star_shaped_ = winds_once();
  solve();
}

size_t AnnulusSurface::index(size_t ring, size_t k) const {
  return ring == 0 ? 0 : 1 + (ring - 1) * sides() + k % sides();
}

Vec3 AnnulusSurface::point(size_t ring, size_t k) const {
  const double s = static_cast<double>(ring) / rings;
  const Vec3 &rim = rim_[k % sides()];
  return {s * rim[0], s * rim[1], height_[index(ring, k)]};
}

void AnnulusSurface::solve() {
  const size_t unknowns = index(rings, 0);
  height_.assign(unknowns + sides(), 0);
  for (size_t k = 0; k < sides(); ++k) height_[index(rings, k)] = rim_[k][2];

  Triplets triplets;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(unknowns));
  for_each_element(sides(), [&](const auto &corner, double share) {
    std::array<Vec3, 3> side;  // opposite to each corner, in the plane
    std::array<size_t, 3> node;
    for (size_t c = 0; c < 3; ++c) {
      const auto &from = corner[(c + 1) % 3], &to = corner[(c + 2) % 3];
      side[c] = point(to[0], to[1]) - point(from[0], from[1]);
      side[c][2] = 0;
      node[c] = index(corner[c][0], corner[c][1]);
    }
    const double twice_area = std::abs(cross_in_plane(side[0], side[1]));
    if (twice_area == 0) return;
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = 0; j < 3 && node[i] < unknowns; ++j) {
        const double stiffness = share * side[i].dot(side[j]) / (2 * twice_area);
        if (node[j] >= unknowns) {
          load[node[i]] -= stiffness * height_[node[j]];
        } else {
          triplets.emplace_back(static_cast<int>(node[i]), static_cast<int>(node[j]), stiffness);
        }
      }
    }
  });
  Eigen::SparseMatrix<double> matrix(load.size(), load.size());
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  const Eigen::VectorXd solution = Eigen::SimplicialLDLT<decltype(matrix)>(matrix).solve(load);
  std::copy(solution.begin(), solution.end(), height_.begin());
}

// Returns whether the rim goes around the centre once, without turning back.
bool AnnulusSurface::winds_once() const {
  size_t crossings = 0;  // of the ray towards +AP
  for (size_t k = 0; k < sides(); ++k) {
    const Vec3 &a = rim_[k], &b = rim_[(k + 1) % sides()];
    if (!(cross_in_plane(a, b) > 0)) return false;
    crossings += a[1] <= 0 && b[1] > 0;
  }
  return crossings == 1;
}

// Returns whether the ray from the centre through p meets a side of the rim between its ends.
bool AnnulusSurface::is_strictly_towards(size_t k, const Vec3 &p) const {
  return cross_in_plane(p, rim_[(k + 1) % sides()]) > 0 && cross_in_plane(rim_[k], p) > 0;
}

// Twice the area of the triangle of a side of the rim and the centre, and those of its parts with p
// in the place of one end of the side, which are the weights of the other end.
AnnulusSurface::Sector AnnulusSurface::sector(size_t k, const Vec3 &p) const {
  const Vec3 &a = rim_[k], &b = rim_[(k + 1) % sides()];
  return {cross_in_plane(a, b), cross_in_plane(p, b), cross_in_plane(a, p)};
}

// Returns the first side of the rim whose triangle with the centre holds p, or sides(). Sectors of
// a star-shaped rim do not overlap, so that one strictly around p is the only one to look at.
size_t AnnulusSurface::find_side(const Vec3 &p, size_t near) const {
  const auto holds = [&](size_t k) {
    const auto [area, toward_a, toward_b] = sector(k, p);
    return !(toward_a < 0 || toward_b < 0 || area <= 0 || toward_a + toward_b > area);
  };
  for (size_t i = 0; star_shaped_ && i < sides(); ++i) {
    // near, then one after the other to both sides of it
    const size_t off = i % 2 == 0 ? i / 2 : sides() - (i + 1) / 2, k = (near + off) % sides();
    if (is_strictly_towards(k, p)) return holds(k) ? k : sides();
  }
  for (size_t k = 0; k < sides(); ++k) {
    if (holds(k)) return k;
  }
  return sides();
}

double AnnulusSurface::height(double u, double v, size_t &near) const {
  const Vec3 p(u, v, 0);
  const size_t k = find_side(p, near);
  if (k == sides()) return std::numeric_limits<double>::quiet_NaN();
  near = k;
  const auto [area, toward_a, toward_b] = sector(k, p);
  // the ray through p meets this side of the rim at a share f; rings are parallel to the side
  const double s = (toward_a + toward_b) / area;
  const double f = s > 0 ? toward_b / (toward_a + toward_b) : 0;
  const size_t ring = std::min(static_cast<size_t>(s * rings), rings - 1);
  const double over = s * rings - static_cast<double>(ring);
  const auto along = [&](size_t r) {
    return (1 - f) * height_[index(r, k)] + f * height_[index(r, k + 1)];
  };
  return (1 - over) * along(ring) + over * along(ring + 1);
}

double AnnulusSurface::area() const {
  double sum = 0;
  for_each_element(sides(), [&](const auto &corner, double share) {
    const Vec3 a = point(corner[0][0], corner[0][1]);
    const Vec3 ab = point(corner[1][0], corner[1][1]) - a;
    const Vec3 ac = point(corner[2][0], corner[2][1]) - a;
    sum += share * 0.5 * ab.cross(ac).norm();
  });
  return sum;
}

}  // namespace mvs::core
