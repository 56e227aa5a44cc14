// Progress and end of a settle.
#include "solve/settle_watch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/math.h"
#include "solve/settings.h"

namespace mvs::core {
namespace {

// m, the longest way of a prescribed node to its target.
double boundary_way(const Model &model, const std::vector<Vec3> &x, double fraction) {
  double square = 0;
  for (uint32_t i = 0; i < x.size(); ++i) {
    if (model.topology.fixed[i]) {
      square = std::max(square, (model.target(i, fraction) - x[i]).squaredNorm());
    }
  }
  return std::sqrt(square);
}

}  // namespace

SettleWatch::SettleWatch(const Model &model, const std::vector<Vec3> &x, const Load &load,
                         double tolerance, const Progress &progress)
    : model_(&model),
      progress_(progress),
      load_(load),
      tolerance_(tolerance),
      way_(boundary_way(model, x, load.boundary_fraction)) {}

void SettleWatch::look(const std::vector<Vec3> &x, double residual) {
  if (++looks_ % settings::settle::looks_per_area == 0) must_hold(x);
  if (!progress_) return;
  share_ = std::max(share_, share_of(x, residual));
  residual_ = residual;
  report(share_, residual);
}

void SettleWatch::poll() const {
  if (progress_ && looks_ > 0) report(share_, residual_);
}

void SettleWatch::finish(double residual) const {
  if (progress_) report(1, residual);
}

void SettleWatch::report(double share, double residual) const {
  MVS_MUST(progress_(share, residual), MVS_E_CANCELLED, "settle",
           "settling was cancelled by the progress callback; the valve is as before");
}

double SettleWatch::share_of(const std::vector<Vec3> &x, double residual) {
  highest_ = std::max(highest_, residual);
  const double travelled =
      way_ > 0 ? 1 - boundary_way(*model_, x, load_.boundary_fraction) / way_ : 1;
  const double before_rest = way_ > 0 ? settings::settle::boundary_progress : 0;
  if (travelled < 1) return before_rest * travelled;
  const double orders = math::log(highest_ / tolerance_), gone = math::log(highest_ / residual);
  const double calmed = orders > 0 ? std::clamp(gone / orders, 0.0, 1.0) : 1;
  return before_rest + (settings::settle::settled_progress - before_rest) * calmed;
}

// A sheet under a follower pressure whose law does not stiffen has a limit load (a balloon): above
// it no equilibrium exists, and the settle would stretch it for ever.
void SettleWatch::must_hold(const std::vector<Vec3> &x) const {
  const Valve &valve = model_->valve;
  std::vector<double> area(valve.leaflets.size(), 0.0), rest_area(valve.leaflets.size(), 0.0);
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const auto [i, j, k] = valve.triangles[t];
    area[valve.triangle_leaflet[t]] += 0.5 * (x[j] - x[i]).cross(x[k] - x[i]).norm();
    rest_area[valve.triangle_leaflet[t]] += model_->rest_area[t];
  }
  for (size_t l = 0; l < area.size(); ++l) {
    const Leaflet &leaflet = valve.leaflets[l];
    MVS_MUST(area[l] <= settings::settle::max_area_ratio * rest_area[l], MVS_E_DIVERGED,
             "leaflet " + leaflet.name,
             "leaflet %s yields without end: its area is %.0f times its rest area, under %g Pa; "
             "its law is too soft to bear this pressure: give it stiffer constants or a greater "
             "thickness, or lower the pressure; the valve is as before",
             leaflet.name.c_str(), area[l] / rest_area[l], load_.pressure);
  }
}

}  // namespace mvs::core
