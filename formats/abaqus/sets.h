// *NSET and *ELSET: lists of numbers, ranges, and sets of sets.
#pragma once

#include "formats/abaqus/mesh.h"

namespace mvs::core {

// Adds items to a set, and creates the set if it does not exist. Duplicates are ignored.
void add_to_inp_set(InpSets &sets, const std::string &level, std::string_view name, int32_t line,
                    const std::vector<uint32_t> &items);

// Reads the sets; call after all nodes and elements are read.
void read_inp_sets(std::vector<InpCard> &cards, InpMesh &mesh);

}  // namespace mvs::core
