// Regurgitant orifice: the surface of least area that separates ventricle and atrium.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

// The smallest cross-section between ventricle and atrium: its area, and its triangles.
struct Orifice {
  double area = 0;  // m2
  std::vector<Vec3> vertices;
  std::vector<Tri> triangles;
};
Orifice measure_orifice(const Model &model, const std::vector<Vec3> &x);

// The same without the quick proof that a valve is sealed: always by the minimum cut.
Orifice cut_orifice(const Model &model, const std::vector<Vec3> &x);

// The same with other tissue within the annulus of the model: triangles of `points`, in any number
// of pieces, wound in any way.
Orifice cut_orifice_of(const std::vector<Vec3> &points, const std::vector<Tri> &triangles,
                       const Model &model, const std::vector<Vec3> &x);

}  // namespace mvs::core
