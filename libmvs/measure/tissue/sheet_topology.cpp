// Hierarchies of the last meshes.
#include "measure/tissue/sheet_topology.h"

#include "base/last_used.h"

namespace mvs::core {
namespace {

struct Kept {
  CowVector<Vec3> rest;
  CowVector<Tri> triangles;
  std::shared_ptr<const BvhTopology> topology;

  // Compares bits; arrays of the same buffer are equal at once.
  bool is_of(const Valve &valve) const {
    CowVector<Vec3> rest_too = rest;
    CowVector<Tri> triangles_too = triangles;
    return triangles_too.share_with(valve.triangles) && rest_too.share_with(valve.rest);
  }
};

}  // namespace

std::shared_ptr<const BvhTopology> sheet_topology(const Model &model) {
  static LastUsed<Kept, 4> last;
  const Valve &valve = model.valve;
  const auto make = [&]() -> Kept {
    return {valve.rest, valve.triangles,
            std::make_shared<const BvhTopology>(valve.rest, valve.triangles, sheet_leaf)};
  };
  return last.find([&](const Kept &kept) { return kept.is_of(valve); }, make).topology;
}

}  // namespace mvs::core
