// Nearest tissue that a node of the sheet faces, in front of its atrial side.
#pragma once

#include <limits>
#include <vector>

#include "measure/coaptation/facing_tree.h"
#include "model/model.h"

namespace mvs::core {

struct Partner {
  uint32_t triangle = none;
  double distance = std::numeric_limits<double>::infinity();  // m
};

// Two pieces of tissue face each other if they lie within reach, atrial side to atrial side: each
// in front of the other, normals more than 120 degrees apart. Tissue beyond the border of the other
// piece is not in front of it. Pieces that share a node do not face each other; two leaflets, or
// the two sides of a cleft of one leaflet, can.
class FacingSurface {
 public:
  FacingSurface(const Model &model, const std::vector<Vec3> &x, const Surface &surface,
                const FacingTree &tree);

  Partner of_node(uint32_t node) const;

 private:
  Partner find(const Vec3 &p, const Vec3 &normal, const Tri &own) const;

  const Model &model_;
  const std::vector<Vec3> &x_;
  const Surface &surface_;
  const FacingTree &tree_;
  std::vector<uint8_t> border_;  // per triangle: bit f is set where feature f is on the border
  double reach_;                 // m: the contact thickness
};

}  // namespace mvs::core
