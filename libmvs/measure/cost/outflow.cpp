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
  double length = 0, before = 0;
  for (const ProfilePiece &piece : profile) {
    const double whole = (piece.to - piece.from).norm();
    if (!facing.begin(piece.triangle)) {
      length += whole;
      before = 0;
      continue;
    }
    const size_t parts = coaptation_parts(model, piece.triangle);
    double last = 0;
    for (size_t k = 0; k <= parts; ++k) {
      const double along = static_cast<double>(k) / static_cast<double>(parts);
      const double weight = facing.weight_of(piece.from + along * (piece.to - piece.from));
      if (weight >= 0.5) {
        // at the start of a piece the weight of the piece before it is the same, or has stepped
        const double share = k == 0 || weight == before
                                 ? along
                                 : last + (along - last) * (0.5 - before) / (weight - before);
        return {length + share * whole, piece.from + share * (piece.to - piece.from)};
      }
      before = weight;
      last = along;
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
  const TriangleBvh tree(model.valve.triangles, x);
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
