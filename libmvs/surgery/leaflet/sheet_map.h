// Coordinates on the leaflets that mean the same on every valve: along a scallop, and from annulus
// to free edge.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

class SheetMap {
 public:
  explicit SheetMap(const Model &model);

  // From annulus, 0, to free edge, 1: the harmonic function of the sheet at rest.
  double height(uint32_t node) const { return height_[node]; }

  // Along a scallop, 0 at its end towards the negative CC axis to 1 at the other, by the angle
  // about the valve's axis at rest.
  double along(uint32_t scallop, uint32_t node) const;

 private:
  struct Range {
    double middle = 0, low = 0, high = 0;  // rad; low and high from the middle
    bool turned = false;                   // angles fall towards the positive CC axis
  };
  double angle(const Range &range, uint32_t node) const;

  std::vector<double> height_, angle_;
  std::vector<Range> ranges_;
};

}  // namespace mvs::core
