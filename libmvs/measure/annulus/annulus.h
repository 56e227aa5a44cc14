// Size and shape of the annulus.
#pragma once

#include <vector>

#include "model/model.h"

namespace mvs::core {

struct AnnulusMeasures {
  double ap = 0, cc = 0, perimeter = 0, area_3d = 0, area = 0, saddle_height = 0,
         nonplanar_angle = 0;
};
AnnulusMeasures measure_annulus(const Model &model, const std::vector<Vec3> &x);

}  // namespace mvs::core
