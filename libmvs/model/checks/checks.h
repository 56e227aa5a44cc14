// The groups of checks behind find_faults, one file each. Each appends to a list of faults.
#pragma once

#include <mvs/base.h>

#include "base/error.h"
#include "model/checks/check.h"
#include "model/winding.h"

namespace mvs::core {

// "chord P2/3", or "chord 17" for a part without a name.
inline std::string part_name(const char *kind, const std::string &name, size_t index) {
  return name.empty() ? format("%s %zu", kind, index) : kind + (" " + name);
}

// The faults found so far; add() appends one with a printf-style sentence.
struct Faults {
  std::vector<Fault> list;

  [[gnu::format(printf, 3, 4)]] void add(const std::string &part, const char *pattern, ...);
};

// Adjacency that the geometric checks share; valid once check_lists has passed.
struct Sheet {
  std::vector<Side> sides;
  Winding winding;
  std::vector<uint8_t> is_vertex;  // 1: a corner of a triangle
};

// Checks sizes of lists and ranges of indices: required lists are not empty, no list exceeds the
// limit, arrays of one kind have equal length. All other checks except check_parts rely on it.
void check_lists(const Valve &valve, Faults &faults);

// Checks names, ids and material constants.
void check_parts(const Valve &valve, Faults &faults);

// Checks that coordinates are finite, in metres, and within one valve. check_sheet, check_annulus
// and check_chords rely on it.
void check_places(const Valve &valve, Faults &faults);

// Checks that the triangles form one oriented manifold sheet that is attached to the annulus and
// faces the atrium.
void check_sheet(const Valve &valve, const Sheet &sheet, Faults &faults);

// Checks that the annulus is a closed loop of boundary edges.
void check_annulus(const Valve &valve, const Sheet &sheet, Faults &faults);

// Checks that chordae join papillary heads to the sheet, and that every node is used.
void check_chords(const Valve &valve, const Sheet &sheet, Faults &faults);

}  // namespace mvs::core
