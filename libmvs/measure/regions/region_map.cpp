// Commissural tissue: triangles of the scallops that meet at a commissure, whose nearest point of
// the annulus, in the rest shape, is close to it along the annulus. The middle of a tall leaflet
// that hangs in a funnel may be nearest to a commissure too, and is not part of it.
#include "measure/regions/region_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/triangle_bvh.h"
#include "measure/annulus/frame.h"
#include "measure/annulus/landmarks.h"

namespace mvs::core {
namespace {

// Half the width of a commissural region over the annulus perimeter: 6 mm for 120 mm.
constexpr double reach_of_perimeter = 0.05;

// The sides of a loop as triangles of two different corners: side k leads from its point k to the
// next.
std::vector<Tri> sides_of(const Loop &loop) {
  std::vector<Tri> sides;
  const uint32_t n = static_cast<uint32_t>(loop.size());
  for (uint32_t k = 0; k < n; ++k) sides.push_back({k, (k + 1) % n, (k + 1) % n});
  return sides;
}

// A place of the annulus where the attachments of two leaflets meet.
struct Commissure {
  std::array<uint32_t, 2> scallops;  // that meet there, in their order
  double at;                         // m along the annulus
  bool has(uint32_t scallop) const { return scallop == scallops[0] || scallop == scallops[1]; }
  bool operator<(const Commissure &other) const {
    return scallops != other.scallops ? scallops < other.scallops : at < other.at;
  }
};

// The commissures in the order of their scallops.
std::vector<Commissure> commissures_of(const Model &model, const Loop &annulus) {
  const Valve &valve = model.valve;
  const std::vector<uint32_t> triangles = annulus_triangles(model);
  std::vector<Commissure> found;
  for (size_t k = 0; k < triangles.size(); ++k) {
    const uint32_t before = triangles[(k + triangles.size() - 1) % triangles.size()];
    const uint32_t after = triangles[k];
    if (before == none || after == none) continue;
    if (valve.triangle_leaflet[before] == valve.triangle_leaflet[after]) continue;
    const auto [low, high] =
        std::minmax({valve.triangle_scallop[before], valve.triangle_scallop[after]});
    found.push_back({{low, high}, annulus.start_of(k)});
  }
  std::sort(found.begin(), found.end());
  return found;
}

// The names of commissures: the scallops that meet there. Where two leaflets without scallops meet
// twice, the side distinguishes them, because a valve is no mirror image of itself: seen from the
// atrium with the anterior leaflet up, the anterolateral commissure is on the left, towards CC of
// the frame. More than two of one name have numbers along the annulus.
std::vector<std::string> commissure_names(const Model &model, const Loop &annulus,
                                          const std::vector<Commissure> &commissures) {
  const Valve &valve = model.valve;
  std::vector<std::string> names;
  for (const auto &c : commissures) {
    std::string name =
        valve.scallops[c.scallops[0]].name + "-" + valve.scallops[c.scallops[1]].name;
    const auto same = [&](const Commissure &other) { return other.scallops == c.scallops; };
    const auto first = std::find_if(commissures.begin(), commissures.end(), same);
    const auto count = std::count_if(commissures.begin(), commissures.end(), same);
    const auto number = &c - &*first;
    if (count == 2) {
      const Vec3 to_other = annulus.at(first[1 - number].at) - annulus.at(c.at);
      const bool is_left = valve_frame(model, valve.rest).axes.row(1).dot(to_other) < 0;
      name += is_left ? " anterolateral" : " posteromedial";
    } else if (count > 2) {
      name += " " + std::to_string(number + 1);
    }
    names.push_back(std::move(name));
  }
  return names;
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
  const std::vector<Commissure> commissures = commissures_of(model, loop);
  for (std::string &name : commissure_names(model, loop, commissures)) {
    names_.push_back(std::move(name));
  }
  const double reach = reach_of_perimeter * loop.length();
  const std::vector<Tri> sides = sides_of(loop);
  const TriangleBvh tree(sides, loop.points());
  for (uint32_t t = 0; t < valve.triangles.size(); ++t) {
    const Tri &corner = valve.triangles[t];
    const auto nearest = tree.closest((rest[corner[0]] + rest[corner[1]] + rest[corner[2]]) / 3);
    const double s =
        loop.start_of(nearest.triangle) + (nearest.point - loop.point(nearest.triangle)).norm();
    double least = reach;
    for (size_t k = 0; k < commissures.size(); ++k) {
      const double off = std::abs(std::remainder(s - commissures[k].at, loop.length()));
      if (off >= least || !commissures[k].has(scallop_of_[t])) continue;
      least = off;
      commissure_of_[t] = static_cast<uint32_t>(scallops_ + k);
    }
  }
}

}  // namespace mvs::core
