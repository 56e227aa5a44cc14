// *NSET and *ELSET: lists of numbers, ranges, and sets of sets.
#pragma once

#include "formats/abaqus/mesh.h"

namespace mvs::core {

// Adds to a set, which begins to be where it is not there yet. Items that are in it are not
// doubled.
void add_to_inp_set(InpSets &sets, const std::string &level, std::string_view name, int32_t line,
                    const std::vector<uint32_t> &items);

// Reads the sets, once all nodes and elements are there.
void read_inp_sets(std::vector<InpCard> &cards, InpMesh &mesh);

}  // namespace mvs::core
