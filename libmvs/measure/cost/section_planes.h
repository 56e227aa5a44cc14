// Planes along the central AP plane in which leaflets are measured.
#pragma once

#include <vector>

#include "model/seams.h"

namespace mvs::core {

enum class SeamsOf { anterior, posterior, both };

struct SectionPlane {
  double offset;  // m along CC from the central AP plane
  double weight;  // of figures in this plane; all together 1
};

// The central AP plane, but where seams of these leaflets lie in it or within one contact thickness
// of it, the planes one contact thickness beside them on either side, weighted so that figures are
// linear between them. The two rims of a seam are a border of the sheet, not the free edge, and the
// central plane runs between them; next to them tissue is gathered in folds.
std::vector<SectionPlane> section_planes(const Model &model, const std::vector<Vec3> &x,
                                         const Seams &seams, SeamsOf leaflets);

}  // namespace mvs::core
