// Anatomical coordinates of leaflets, comparable between valves: position along a scallop, and
// harmonic height from annulus to free edge.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

class SheetMap {
 public:
  explicit SheetMap(const Model &model);

  // Height from the annulus (0) to the free edge (1): harmonic function on the sheet at rest.
  double height(uint32_t node) const { return height_[node]; }

  // Position along a scallop by the angle about the axis at rest: 0 at its end towards the negative
  // CC axis, 1 at the other.
  double along(uint32_t scallop, uint32_t node) const;

 private:
  struct Range {
    double middle = 0, low = 0, high = 0;  // rad; low and high from the middle
    bool turned = false;                   // angles decrease towards the positive CC axis
  };
  double angle(const Range &range, uint32_t node) const;

  std::vector<double> height_, angle_;
  std::vector<Range> ranges_;
};

}  // namespace mvs::core
