// Groups of chordae whose rest lengths change together.
#pragma once

#include <string>
#include <vector>

#include "model/model.h"

namespace mvs::core {

struct ChordGroup {
  std::string name;              // "A marginal" or "A marginal, PM"
  std::vector<uint32_t> chords;  // indices, ascending
};

enum class ChordGrouping {
  kinds,  // leaflet and kind; both muscles, and commissural chordae of both leaflets, together
  halves  // and papillary muscle: heads with the same name but for its number
};

// In the order of their first chord. A trunk belongs to the group of its first leaf; sutures belong
// to none.
std::vector<ChordGroup> chord_groups(const Model &model, ChordGrouping grouping);

// Multiplies the rest lengths of each group by its factor.
void scale_groups(Valve &valve, const std::vector<ChordGroup> &groups,
                  const std::vector<double> &factor);

}  // namespace mvs::core
