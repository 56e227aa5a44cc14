#include "measure/cost/outflow.h"

#include <algorithm>
#include <limits>

#include "measure/coaptation/coaptation_parts.h"
#include "measure/coaptation/facing_weight.h"
#include "measure/cost/central_profile.h"

namespace mvs::core {
namespace {

// The first point of a profile that faces other tissue with a weight of at least one half, as in
// central_section, and the length up to it.
struct Begin {
  double length = std::numeric_limits<double>::quiet_NaN();
  std::optional<Vec3> point;
};

Begin find_coaptation(const Model &model, const std::vector<ProfilePiece> &profile,
                      FacingWeight &facing) {
  double length = 0;
  for (const ProfilePiece &piece : profile) {
    const double whole = (piece.to - piece.from).norm();
    if (!facing.begin(piece.triangle)) {
      length += whole;
      continue;
    }
    const size_t parts = coaptation_parts(model, piece.triangle);
    const auto along = [&](double k) { return k / static_cast<double>(parts); };
    FacingPoints points;
    for (size_t k = 0; k <= parts; ++k) {
      points.add(piece.from + along(static_cast<double>(k)) * (piece.to - piece.from));
    }
    const FacingPoints::Row weight = facing.weights_of(points);
    for (size_t k = 0; k <= parts; ++k) {
      if (weight[k] < 0.5) continue;
      // linear from the point before; the first point has that of the piece before, or a step
      const double back = k == 0 ? 0 : (weight[k] - 0.5) / (weight[k] - weight[k - 1]);
      const double share = along(static_cast<double>(k) - back);
      return {length + share * whole, piece.from + share * (piece.to - piece.from)};
    }
    length += whole;
  }
  return {};
}

}  // namespace

double Outflow::distance_to(const std::vector<Vec3> &septum) const {
  if (!coaptation || septum.empty()) return std::numeric_limits<double>::quiet_NaN();
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3 &p : septum) least = std::min(least, (p - *coaptation).norm());
  return least;
}

Outflow measure_outflow(const Model &model, const std::vector<Vec3> &x) {
  const Surface surface = surface_of(model.valve.triangles, x);
  const FacingTree tree(model, x, surface);
  FacingWeight facing(model, x, surface, tree);
  const Begin anterior = find_coaptation(model, central_profile(model, x, true), facing);
  const Begin posterior = find_coaptation(model, central_profile(model, x, false), facing);
  const std::vector<Vec3> &rest = model.valve.rest;
  Outflow outflow = {length_of(central_profile(model, rest, true)),
                     length_of(central_profile(model, rest, false)), anterior.length,
                     posterior.length, std::nullopt};
  if (anterior.point && posterior.point) {
    outflow.coaptation = 0.5 * (*anterior.point + *posterior.point);
  }
  return outflow;
}

}  // namespace mvs::core
