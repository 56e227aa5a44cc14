// The mesh of an Abaqus input file: nodes, elements, and the sets that name them.
#pragma once

#include <array>
#include <map>
#include <set>

#include "base/types.h"
#include "formats/abaqus/notes.h"

namespace mvs::core {

// Powers of ten: lengths are divided by 10^length to be in m, stresses by 10^stress to be in Pa.
// Time is in s, so that the unit of mass follows: stress x length x s2.
struct InpUnits {
  int length = 3, stress = -6;  // mm, MPa, and so tonne
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
  std::vector<uint32_t> nodes;  // as in InpMesh::nodes: 2 a truss, 3 or 4 a shell
};

struct InpSet {
  std::string name;  // as written
  int32_t line = 0;
  std::vector<uint32_t> items;  // of InpMesh::nodes or elements, each once
  std::set<uint32_t> members;   // the same
};
using InpSets = std::map<std::string, InpSet>;

struct InpMesh {
  InpUnits units;
  std::vector<InpNode> nodes;                        // in the order of the file
  std::vector<InpElement> elements;                  // in the order of the file
  std::map<uint64_t, uint32_t> node_of, element_of;  // by number
  std::set<uint64_t> skipped;       // numbers of elements that a valve has no place for
  InpSets node_sets, element_sets;  // by label; "@" before those of the assembly
  std::string heading;              // its first line, if a valve can have that name
  std::string part, instance;       // labels, empty without

  // What a number, a set, or either of them behind "instance." names; fails where it is nothing.
  std::vector<uint32_t> named_nodes(std::string_view word, int32_t line) const;
  std::vector<uint32_t> named_elements(std::string_view word, int32_t line) const;
  // The set of a label; null where there is none.
  const InpSet *find_set(const InpSets &sets, std::string_view word) const;
};

// Reads *PART, *INSTANCE, *NODE, *ELEMENT, *NSET and *ELSET.
InpMesh read_inp_mesh(std::vector<InpCard> &cards, const InpUnits &units, InpNotes &notes);

}  // namespace mvs::core
