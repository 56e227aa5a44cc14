// Tissue of the regions to which the tissue closest to each of many places belongs.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "geometry/closest_nearby.h"
#include "measure/regions/region_map.h"

namespace mvs::core {

// A place, and tissue of the regions of the tissue that is closest to it.
struct RegionPlace {
  Vec3 place;
  size_t index;  // of the caller
  uint32_t tissue = none;
};

// Where all triangles that can be closest to any of some places belong to the same regions, these
// places are done; else each quarter of them, divided along their longest extents, looks among
// these triangles, down to single places. The result is that of a search for each place.
class RegionSearch {
 public:
  // Keeps references to both.
  RegionSearch(const TriangleBvh &tree, const RegionMap &map) : tree_(tree), map_(map) {}

  // Sets the tissue of places that lie near each other, and reorders them.
  void find(std::span<RegionPlace> places);

 private:
  struct Ball {
    Vec3 centre;
    double radius;
  };

  static Ball ball_of(std::span<const RegionPlace> places);
  void fill(std::span<RegionPlace> places, const Ball &ball, const std::vector<uint32_t> &among,
            size_t depth);

  const TriangleBvh &tree_;
  const RegionMap &map_;
  uint32_t nearest_ = none;  // to the centre of the last ball
  std::vector<NearTriangle> near_;
  // By depth: triangles left for the quarters. References into it stay.
  std::deque<std::vector<uint32_t>> left_;
};

}  // namespace mvs::core
