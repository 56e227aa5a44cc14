// Walking over a sheet to the triangle that is nearest to a point: other parts of the sheet that
// touch this one in space are far away for it.
#pragma once

#include "model/model.h"

namespace mvs::core {

class SheetWalk {
 public:
  // Keeps a reference to the model.
  explicit SheetWalk(const Model &model) : model_(model) {}

  // Starts from the triangles around a node, of one scallop only if `scallop` is not `none`, and
  // goes on to nearer ones among those that touch it until there is none. `none` if there is no
  // start.
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
