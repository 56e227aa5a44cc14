// Hierarchies of the last meshes.
#include "measure/tissue/sheet_topology.h"

#include <algorithm>
#include <mutex>
#include <vector>

namespace mvs::core {
namespace {

constexpr size_t most_kept = 4;

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
  static std::mutex mutex;
  static std::vector<Kept> last;
  const Valve &valve = model.valve;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    const auto found =
        std::find_if(last.begin(), last.end(), [&](const Kept &kept) { return kept.is_of(valve); });
    if (found != last.end()) {
      std::rotate(found, found + 1, last.end());
      return last.back().topology;
    }
  }
  // outside of the lock: two threads may make the same topology, and either will do
  auto made = std::make_shared<const BvhTopology>(valve.rest, valve.triangles, sheet_leaf);
  const std::lock_guard<std::mutex> lock(mutex);
  if (last.size() == most_kept) last.erase(last.begin());
  last.push_back({valve.rest, valve.triangles, made});
  return made;
}

}  // namespace mvs::core
