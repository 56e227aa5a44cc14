// Extent of the stretches of a section that face other tissue with a weight of at least one half,
// their ends interpolated.
#include "measure/coaptation/central_section.h"

#include <algorithm>
#include <array>
#include <limits>

#include "measure/coaptation/coaptation_parts.h"

namespace mvs::core {
namespace {

// Tissue with a weight below one half counts as if this much lower (for the highest point) at
// weight 0: the extent is then continuous where a new stretch of tissue begins to coapt.
constexpr double penalty = 0.05;  // m

// The highest and the lowest coapted point of all sections.
class Extent {
 public:
  void add(double height, double weight) {
    if (weight <= 0) return;
    const double off = penalty * std::max(0.0, 1 - 2 * weight);
    highest_ = std::max(highest_, height - off);
    lowest_ = std::min(lowest_, height + off);
  }
  // A piece of a section between two points; the weight is linear between them.
  void add(double h0, double w0, double h1, double w1) {
    add(h0, w0);
    add(h1, w1);
    if ((w0 < 0.5) != (w1 < 0.5)) add(h0 + (h1 - h0) * (0.5 - w0) / (w1 - w0), 0.5);
  }
  bool is_empty() const { return !(highest_ >= lowest_); }
  double highest() const { return highest_; }
  double lowest() const { return lowest_; }

 private:
  double lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_;
};

// The segment in which a plane across CC cuts a triangle; returns whether there is one.
bool cut(const std::array<Vec3, 3> &corner, double plane, std::array<Vec3, 2> &ends) {
  size_t count = 0;
  for (size_t k = 0; k < 3; ++k) {
    const Vec3 &a = corner[k], &b = corner[(k + 1) % 3];
    if ((a[1] < plane) == (b[1] < plane)) continue;
    ends[count++] = a + (plane - a[1]) / (b[1] - a[1]) * (b - a);
  }
  return count == 2;
}

}  // namespace

void measure_central_section(const Model &model, const std::vector<Vec3> &local,
                             const std::vector<Vec3> &x, FacingWeight &facing,
                             Coaptation &coaptation) {
  const double thickness = model.valve.contact_thickness;
  facing.leave_out_folds();
  Extent extent;
  for (uint32_t t = 0; t < model.valve.triangles.size(); ++t) {
    const Tri &c = model.valve.triangles[t];
    const std::array<Vec3, 3> corner = {local[c[0]], local[c[1]], local[c[2]]};
    const auto across = std::minmax({corner[0][1], corner[1][1], corner[2][1]});
    if (across.first > thickness || across.second < -thickness || !facing.begin(t)) continue;
    // from the frame of the valve to space, along the sides of this triangle
    const Vec3 u = corner[1] - corner[0], v = corner[2] - corner[0];
    const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), det = uu * vv - uv * uv;
    const auto in_space = [&](const Vec3 &p) -> Vec3 {
      const double pu = (p - corner[0]).dot(u), pv = (p - corner[0]).dot(v);
      const double a = (vv * pu - uv * pv) / det, b = (uu * pv - uv * pu) / det;
      return x[c[0]] + a * (x[c[1]] - x[c[0]]) + b * (x[c[2]] - x[c[0]]);
    };
    const size_t pieces = coaptation_parts(model, t);
    for (const double plane : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      std::array<Vec3, 2> ends;
      if (!cut(corner, plane * thickness, ends) || !(det > 0)) continue;
      FacingPoints points;
      FacingPoints::Row height;
      for (size_t k = 0; k <= pieces; ++k) {
        const double along = static_cast<double>(k) / static_cast<double>(pieces);
        const Vec3 p = ends[0] + along * (ends[1] - ends[0]);
        height[k] = p[2];
        points.add(in_space(p));
      }
      const FacingPoints::Row weight = facing.weights_of(points);
      for (size_t k = 1; k <= pieces; ++k) {
        extent.add(height[k - 1], weight[k - 1], height[k], weight[k]);
      }
    }
  }
  if (extent.is_empty()) return;
  coaptation.height = extent.highest() - extent.lowest();
  coaptation.depth = -extent.highest();
}

}  // namespace mvs::core
