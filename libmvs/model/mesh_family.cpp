// Comparison of meshes, and the list of coarser meshes of a family.
#include "model/mesh_family.h"

#include <algorithm>

#include "model/model.h"

namespace mvs::core {
namespace {

// Coarser meshes that a family keeps: more are needed only if variants differ in the chordae that
// may be merged.
constexpr size_t most_levels = 4;

// Compares bits; arrays of the same buffer are equal at once.
template <typename T>
bool has_same_bits(const CowVector<T> &a, const CowVector<T> &b) {
  CowVector<T> copy = a;
  return copy.share_with(b);
}

template <typename T, typename Same>
bool all_same(const CowVector<T> &a, const CowVector<T> &b, Same same) {
  return a.get().size() == b.get().size() &&
         std::equal(a.get().begin(), a.get().end(), b.get().begin(), same);
}

bool counts_up(const std::vector<uint32_t> &numbers) {
  for (size_t k = 0; k < numbers.size(); ++k) {
    if (numbers[k] != k) return false;
  }
  return true;
}

// In the functions below `a` may leave out what complete() fills in; `b` is complete.

bool has_same_nodes(const Valve &a, const Valve &b) {
  const auto has_same_places = [&](const CowVector<Vec3> &given, const CowVector<Vec3> &places) {
    return has_same_bits(given.empty() ? a.rest : given, places);
  };
  return has_same_bits(a.rest, b.rest) && has_same_places(a.open, b.open) &&
         has_same_places(a.loaded, b.loaded) &&
         (a.origin.empty() ? counts_up(b.origin) : has_same_bits(a.origin, b.origin));
}

bool has_same_scallops(const Valve &a, const Valve &b) {
  if (a.scallops.empty()) {
    std::vector<uint32_t> leaflet_of;
    for (const Scallop &scallop : b.scallops) leaflet_of.push_back(scallop.leaflet);
    return b.scallops.size() == b.leaflets.size() && counts_up(leaflet_of) &&
           has_same_bits(a.triangle_leaflet, b.triangle_scallop);
  }
  return has_same_bits(a.triangle_scallop, b.triangle_scallop) &&
         all_same(a.scallops, b.scallops,
                  [](const Scallop &s, const Scallop &t) { return s.leaflet == t.leaflet; });
}

bool has_same_sheet(const Valve &a, const Valve &b) {
  return has_same_bits(a.triangles, b.triangles) && a.leaflets.size() == b.leaflets.size() &&
         has_same_bits(a.triangle_leaflet, b.triangle_leaflet) && has_same_scallops(a, b) &&
         (a.triangle_fibre.empty() || has_same_bits(a.triangle_fibre, b.triangle_fibre)) &&
         has_same_bits(a.annulus, b.annulus);
}

bool has_same_chordae(const Valve &a, const Valve &b) {
  return all_same(a.heads, b.heads,
                  [](const Head &h, const Head &other) { return h.node == other.node; }) &&
         all_same(a.chords, b.chords, [](const Chord &c, const Chord &d) {
           return c.a == d.a && c.b == d.b && c.kind == d.kind;
         });
}

}  // namespace

bool has_mesh_of(const Valve &valve, const Model &model) {
  return has_same_nodes(valve, model.valve) && has_same_sheet(valve, model.valve) &&
         has_same_chordae(valve, model.valve);
}

std::vector<std::shared_ptr<const FamilyLevel>> MeshFamily::levels() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return levels_;
}

void MeshFamily::keep(std::shared_ptr<const FamilyLevel> level, size_t known) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (levels_.size() == known && known < most_levels) levels_.push_back(std::move(level));
}

}  // namespace mvs::core
