// Mesh of an Abaqus input file: nodes, elements and sets.
#pragma once

#include <array>
#include <map>
#include <set>

#include "base/types.h"
#include "formats/abaqus/notes.h"

namespace mvs::core {

// Units as powers of ten: lengths divided by 10^length are in m, stresses divided by 10^stress in
// Pa. Time is in s; the unit of mass follows: stress x length x s2.
struct InpUnits {
  int length = 3, stress = -6;  // mm, MPa, tonne
  int density() const { return stress - 2 * length; }
};

struct InpNode {
  uint64_t number;
  Vec3 x;  // m
  int32_t line;
};

struct InpElement {
  uint64_t number;
  int32_t line;
  std::vector<uint32_t> nodes;  // indices into InpMesh::nodes: 2 for a truss, 3 or 4 for a shell
};

struct InpSet {
  std::string name;  // as written
  int32_t line = 0;
  std::vector<uint32_t> items;  // indices into InpMesh::nodes or elements, each once
  std::set<uint32_t> members;   // the same
};
using InpSets = std::map<std::string, InpSet>;

struct InpMesh {
  InpUnits units;
  std::vector<InpNode> nodes;                        // in the order of the file
  std::vector<InpElement> elements;                  // in the order of the file
  std::map<uint64_t, uint32_t> node_of, element_of;  // by number
  std::set<uint64_t> skipped;                        // numbers of elements of unsupported types
  InpSets node_sets, element_sets;                   // by label; "@" before those of the assembly
  std::string heading;                               // its first line, if it is a valid name
  std::string part, instance;                        // labels; empty if absent

  // Resolves a number or a set, with or without "instance." before it; fails if it does not exist.
  std::vector<uint32_t> named_nodes(std::string_view word, int32_t line) const;
  std::vector<uint32_t> named_elements(std::string_view word, int32_t line) const;
  // Returns the set of a label, or null.
  const InpSet *find_set(const InpSets &sets, std::string_view word) const;
};

// Reads *PART, *INSTANCE, *NODE, *ELEMENT, *NSET and *ELSET.
InpMesh read_inp_mesh(std::vector<InpCard> &cards, const InpUnits &units, InpNotes &notes);

}  // namespace mvs::core
