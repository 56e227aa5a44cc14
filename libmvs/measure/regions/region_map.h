// Regions of the sheet: the scallops, and the tissue near each commissure.
#pragma once

#include <string>
#include <vector>

#include "model/model.h"

namespace mvs::core {

// A property of the model, so that no motion changes the regions. Regions are numbered: first the
// scallops in their order, then the commissures.
class RegionMap {
 public:
  explicit RegionMap(const Model &model);

  size_t size() const { return names_.size(); }
  size_t scallops() const { return scallops_; }
  const std::string &name(size_t region) const { return names_[region]; }

  // Calls visit(region) for the scallop of a triangle, and for the commissure that it is near.
  template <typename Visit>
  void for_each(uint32_t triangle, Visit visit) const {
    visit(scallop_of_[triangle]);
    if (commissure_of_[triangle] != none) visit(commissure_of_[triangle]);
  }

  // Whether two triangles belong to the same regions.
  bool same_regions(uint32_t a, uint32_t b) const {
    return scallop_of_[a] == scallop_of_[b] && commissure_of_[a] == commissure_of_[b];
  }

 private:
  void find_commissures(const Model &model);

  size_t scallops_;
  std::vector<std::string> names_;
  std::vector<uint32_t> scallop_of_, commissure_of_;  // per triangle
};

}  // namespace mvs::core
