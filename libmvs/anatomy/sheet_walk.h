// Greedy search for the nearest triangle by walking over a sheet: parts of the sheet that touch
// this one in space are not reached.
#pragma once

#include "model/model.h"

namespace mvs::core {

class SheetWalk {
 public:
  // Keeps a reference to the model.
  explicit SheetWalk(const Model &model) : model_(model) {}

  // Starts at the triangles around a node, of one scallop only unless `scallop` is `none`, and
  // moves to nearer triangles among those that touch the present one, until it finds a local
  // minimum. Returns `none` without a triangle to start from.
  uint32_t nearest(uint32_t node, const Vec3 &p, uint32_t scallop = none) const;

 private:
  struct Nearest {
    double distance2;
    uint32_t triangle;
  };
  void look_around(uint32_t node, const Vec3 &p, uint32_t scallop, Nearest &nearest) const;

  const Model &model_;
};

}  // namespace mvs::core
