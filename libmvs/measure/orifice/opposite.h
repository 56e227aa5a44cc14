// Whether a point of the sheet has other tissue in front of it: boxes rule out most triangles,
// eight boxes at a time; the nearest points of the rest decide, four triangles at a time.
#pragma once

#include <array>
#include <vector>

#include "geometry/aabb.h"

namespace mvs::core::orifice {

// A point of the sheet, with the directions in which tissue counts as opposite: within 60 degrees
// of the normal, to either side, and for a point of a rim also of the direction out of the sheet.
// The directions exclude the neighbourhood of the point itself.
struct OppositeQuery {
  Vec3 p, normal, out = Vec3::Zero();
};

class Opposite {
 public:
  Opposite(const std::vector<Tri> &triangles, const std::vector<Vec3> &x);

  // Whether there is tissue in one of these directions, nearer than a distance in m.
  bool is_within(const OppositeQuery &query, double distance) const;

  // Boxes around groups of four triangles, by coordinate; rows of eight are full.
  struct Boxes {
    std::array<std::vector<float>, 3> centre, half;
    size_t size() const { return half[0].size(); }
    void add(const Aabb &box, double margin);
    void fill_row();
  };
  // The corners of a group: coordinate c of corner k of triangle i is at[k][c][i].
  struct Group {
    std::array<std::array<std::array<double, 4>, 3>, 3> at;
  };

 private:
  Boxes rows_, boxes_;  // rows of eight groups, and groups
  std::vector<Group> groups_;
};

}  // namespace mvs::core::orifice
