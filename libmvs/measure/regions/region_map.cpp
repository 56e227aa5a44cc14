// Commissural tissue: triangles whose nearest point of the annulus, in the rest shape, is close to
// a commissure along the annulus.
#include "measure/regions/region_map.h"

#include <cmath>

#include "geometry/bvh.h"
#include "measure/annulus/landmarks.h"

namespace mvs::core {
namespace {

// Half the width of a commissural region over the annulus perimeter: 6 mm for 120 mm.
constexpr double reach_of_perimeter = 0.05;

// Arc length of the annulus point that is nearest to p.
class NearestOnLoop {
 public:
  explicit NearestOnLoop(const Loop &loop)
      : loop_(loop), sides_(sides_of(loop)), tree_(sides_, loop.points()) {}

  double operator()(const Vec3 &p) const {
    const TriangleBvh::Hit hit = tree_.closest(p);
    return loop_.start_of(hit.triangle) + (hit.point - loop_.point(hit.triangle)).norm();
  }

 private:
  static std::vector<Tri> sides_of(const Loop &loop) {
    std::vector<Tri> sides;
    const uint32_t n = static_cast<uint32_t>(loop.size());
    for (uint32_t k = 0; k < n; ++k) sides.push_back({k, (k + 1) % n, (k + 1) % n});
    return sides;
  }

  const Loop &loop_;
  std::vector<Tri> sides_;
  TriangleBvh tree_;
};

// The scallop at the annulus edge that holds a place of the loop; `none` without tissue there.
uint32_t scallop_at(const Model &model, const Loop &loop, const std::vector<uint32_t> &triangles,
                    double s) {
  s -= loop.length() * std::floor(s / loop.length());
  size_t edge = 0;
  while (edge + 1 < loop.size() && loop.start_of(edge + 1) <= s) ++edge;
  return triangles[edge] == none ? none : model.valve.triangle_scallop[triangles[edge]];
}

}  // namespace

RegionMap::RegionMap(const Model &model)
    : scallops_(model.valve.scallops.size()),
      scallop_of_(model.valve.triangle_scallop.begin(), model.valve.triangle_scallop.end()),
      commissure_of_(model.valve.triangles.size(), none) {
  for (const Scallop &scallop : model.valve.scallops) names_.push_back(scallop.name);
  find_commissures(model);
}

void RegionMap::find_commissures(const Model &model) {
  const Valve &valve = model.valve;
  const std::vector<Vec3> &rest = valve.rest;
  const Loop loop(valve.annulus, rest);
  const Arc arc = attachment(model, loop, anterior_leaflet(valve));
  if (arc.length() == 0) return;  // the leaflet has no ends
  const std::vector<uint32_t> triangles = annulus_triangles(model);
  const double reach = reach_of_perimeter * loop.length();
  const double inside = 1e-6 * loop.length();  // from the commissure to the edges beside it
  const uint32_t first = static_cast<uint32_t>(names_.size());
  for (const auto &[at, inwards] : {std::pair(arc.from, inside), std::pair(arc.to, -inside)}) {
    const auto name_at = [&](double s) {
      const uint32_t scallop = scallop_at(model, loop, triangles, s);
      return scallop == none ? std::string() : valve.scallops[scallop].name;
    };
    const std::string anterior = name_at(at + inwards), other = name_at(at - inwards);
    names_.push_back(anterior + "-" + other);
  }
  const NearestOnLoop nearest(loop);
  for (uint32_t t = 0; t < valve.triangles.size(); ++t) {
    const Tri &c = valve.triangles[t];
    const double s = nearest((rest[c[0]] + rest[c[1]] + rest[c[2]]) / 3);
    for (uint32_t k = 0; k < 2; ++k) {
      const double off = std::remainder(s - (k == 0 ? arc.from : arc.to), loop.length());
      if (std::abs(off) < reach) commissure_of_[t] = first + k;
    }
  }
}

}  // namespace mvs::core
