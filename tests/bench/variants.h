// Variants of a generated valve: the same mesh with other rest lengths, stiffnesses and pressure.
#pragma once

#include <mvs/mvs.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace bench {

// The arrays of a valve, and a description of each variant by its number: every rest length within
// 3 %, and, one factor for all chordae, one for each leaflet and one for the pressure, within 20 %.
class Variants {
 public:
  explicit Variants(const mvs::Snapshot &valve);

  // Sets the valve and the load of a variant.
  void set(mvs::Simulator &sim, uint64_t number) const;

 private:
  std::vector<mvs_chord_desc> chords_;
  std::vector<mvs_leaflet_desc> leaflets_;
  std::vector<mvs_head_desc> heads_;
  std::vector<std::string> names_;  // of leaflets and scallops
  std::vector<const char *> scallops_;
  mvs::Snapshot valve_;  // holds the arrays that variants have in common
};

}  // namespace bench
