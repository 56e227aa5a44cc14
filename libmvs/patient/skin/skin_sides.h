// The two sides of a closed skin.
#pragma once

#include <array>
#include <vector>

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// Cosine of 37 degrees: triangles of a side face one that is parallel within it, triangles of a
// rounded rim face none from there on.
inline constexpr double parallel_cosine = 0.8;

// Distance along a ray to a triangle (Moeller & Trumbore 1997); negative if it passes by.
double ray_distance(const Vec3 &from, const Vec3 &way, const Vec3 &a, const Vec3 &b, const Vec3 &c);

// The tissue behind a triangle, along a ray from its centroid inward.
struct TissueBehind {
  double thickness = 0;      // m; 0 if the ray leaves nowhere within 12 mm
  uint32_t triangle = none;  // where it leaves
};
// Normals of `skin` point out of the tissue.
std::vector<TissueBehind> tissue_behind(const LeafletSheet &skin);
// The median of the thickness behind triangles with tissue behind them, m; 0 without any.
double median_thickness(const std::vector<TissueBehind> &behind);

// The side of each triangle, 0 or 1; `none` for the bands at the rims. `sharp_rims`: the bands are
// flat and meet the sides at ridges, up to which the sides go; else the skin is round there.
std::vector<uint32_t> sides_of(const LeafletSheet &skin, const std::vector<TissueBehind> &behind,
                               bool sharp_rims);

}  // namespace mvs::core
