// Branch and bound over a quadtree of the cells, with the triangles near a ball around each square.
#include "measure/regions/region_depths.h"

#include <algorithm>
#include <cmath>

#include "geometry/closest_nearby.h"

namespace mvs::core {
namespace {

// Differences of distances over the contact thickness up to which a cell belongs to a region as
// much as to the nearest, and from which it does not. The ball between two leaflets rests within a
// cell of the middle, 0.13 of a default thickness: it is nearer to one of them by up to twice that.
constexpr double as_near = 0.25, too_far = 0.75;
// m, above rounding of distances.
constexpr double rounding_of_distances = 1e-12;
// Cells of a side of the largest squares.
constexpr int largest_square = 16;
static_assert(AnnulusMap::across % largest_square == 0);

// Cells of the raster with the box of those that are below the annulus plane.
struct Square {
  int column, row, size;
  double depth = 0;  // of the deepest cell
  Aabb box;

  Vec3 centre() const { return 0.5 * (box.low + box.high); }
  double radius() const { return 0.5 * (box.high - box.low).norm(); }
};

class DepthSearch {
 public:
  // Keeps references to all.
  DepthSearch(const AtrialSurface &atrial, const RegionMap &map, const TriangleBvh &tree,
              double thickness, std::vector<double> &deepest)
      : atrial_(atrial), map_(map), tree_(tree), thickness_(thickness), deepest_(deepest) {}

  void look_at_all() {
    std::vector<Square> squares;
    for (int row = 0; row < AnnulusMap::across; row += largest_square) {
      for (int column = 0; column < AnnulusMap::across; column += largest_square) {
        squares.push_back(square_of(column, row, largest_square));
      }
    }
    for (const Vec3 &low : atrial_.lows) squares.push_back(square_of(low));
    sort_by_depth(squares);
    uint32_t hint = none;
    for (const Square &square : squares) {
      if (!may_raise_any(square.depth)) return;
      // a triangle counts for a cell up to `too_far` beyond the nearest, as if the ball were larger
      const ClosestNearby near(tree_, square.centre(), square.radius() + 0.5 * too_far * thickness_,
                               hint);
      hint = near.closest_to_centre();
      look_at(square, near.triangles());
    }
  }

 private:
  Square square_of(int column, int row, int size) const {
    Square square{column, row, size, 0, {}};
    for (int r = row; r < row + size; ++r) {
      for (int c = column; c < column + size; ++c) {
        const size_t cell = AnnulusMap::at(c, r);
        const double here = atrial_.depth(cell);
        if (!(here > 0)) continue;
        square.depth = std::max(square.depth, here);
        square.box.add(Vec3(atrial_.map->u()[static_cast<size_t>(c)],
                            atrial_.map->v()[static_cast<size_t>(r)], atrial_.heights[cell]));
      }
    }
    return square;
  }
  // A low counts as a cell.
  static Square square_of(const Vec3 &low) {
    Square square{0, 0, 1, std::max(0.0, -low[2]), {}};
    square.box.add(low);
    return square;
  }
  // The deepest first: what they raise leaves less to look at.
  static void sort_by_depth(std::vector<Square> &squares) {
    std::stable_sort(squares.begin(), squares.end(),
                     [](const Square &a, const Square &b) { return a.depth > b.depth; });
  }

  bool may_raise_any(double depth) const {
    return std::any_of(deepest_.begin(), deepest_.end(), [&](double d) { return d < depth; });
  }
  // The share of a cell that is further from a region than from the nearest by so much.
  double share_of(double further) const {
    return std::clamp((too_far - further / thickness_) / (too_far - as_near), 0.0, 1.0);
  }
  // Whether a triangle may raise the value of a region by cells of the square: from its centre to a
  // cell a difference of distances changes by at most twice the radius.
  bool may_raise(const Square &square, const NearTriangle &n, double least) const {
    const double further =
        std::sqrt(n.distance2) - least - 2 * square.radius() - rounding_of_distances;
    const double depth = square.depth * share_of(further);
    bool may = false;
    map_.for_each(n.triangle, [&](uint32_t region) { may |= deepest_[region] < depth; });
    return may;
  }

  // Lists the triangles that can be near enough to a cell of the square, with the squared distance
  // from its centre. The nearest is among them.
  std::vector<NearTriangle> near_to(const Square &square,
                                    const std::vector<uint32_t> &among) const {
    std::vector<NearTriangle> near;
    list_nearby(tree_, among, square.centre(), square.radius() + 0.5 * too_far * thickness_, near);
    std::sort(near.begin(), near.end(), [](const NearTriangle &a, const NearTriangle &b) {
      return a.distance2 < b.distance2 || (a.distance2 == b.distance2 && a.triangle < b.triangle);
    });
    return near;
  }

  void look_at(const Square &square, const std::vector<uint32_t> &among) {
    const std::vector<NearTriangle> near = near_to(square, among);
    const double least = std::sqrt(near.front().distance2);
    if (square.size == 1) return raise(square.depth, near);
    // left are triangles that can raise a value, and those that can be the nearest to a cell; the
    // nearest to the centre first
    const double limit2 = nearby_limit2(near.front().distance2, square.radius());
    std::vector<uint32_t> left;
    bool may_any = false;
    for (const NearTriangle &n : near) {
      const bool may = may_raise(square, n, least);
      may_any |= may;
      if (may || n.distance2 <= limit2) left.push_back(n.triangle);
    }
    if (!may_any) return;
    const int half = square.size / 2;
    std::vector<Square> quarters;
    for (const int row : {square.row, square.row + half}) {
      for (const int column : {square.column, square.column + half}) {
        quarters.push_back(square_of(column, row, half));
      }
    }
    sort_by_depth(quarters);
    for (const Square &quarter : quarters) {
      if (quarter.depth > 0) look_at(quarter, left);
    }
  }

  // `near`: sorted by distance from the cell.
  void raise(double depth, const std::vector<NearTriangle> &near) {
    const double nearest = std::sqrt(near.front().distance2);
    for (const NearTriangle &n : near) {
      const double share = share_of(std::sqrt(n.distance2) - nearest);
      map_.for_each(n.triangle, [&](uint32_t region) {
        deepest_[region] = std::max(deepest_[region], share * depth);
      });
    }
  }

  const AtrialSurface &atrial_;
  const RegionMap &map_;
  const TriangleBvh &tree_;
  double thickness_;
  std::vector<double> &deepest_;
};

}  // namespace

void raise_depths(const AtrialSurface &atrial, const RegionMap &map, const TriangleBvh &tree,
                  double thickness, std::vector<double> &deepest) {
  DepthSearch(atrial, map, tree, thickness, deepest).look_at_all();
}

}  // namespace mvs::core
