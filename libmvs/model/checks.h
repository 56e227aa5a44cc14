// The groups of checks behind find_faults, one file each. Each appends to the list of faults.
#pragma once

#include <mvs/base.h>

#include "base/error.h"
#include "model/check.h"
#include "model/winding.h"

namespace mvs::core {

// The faults found so far; says one with a printf-style sentence.
struct Faults {
  std::vector<Fault> list;

  [[gnu::format(printf, 3, 4)]] void add(const std::string &part, const char *pattern, ...);
};

// What the geometric checks share; made once sizes and indices are in order.
struct Sheet {
  std::vector<Side> sides;
  Winding winding;
  std::vector<uint8_t> is_vertex;  // 1: a corner of a triangle
};

// No list is empty that must not be or longer than a valve can use; lists go together; every index
// names something. The other checks but check_parts rely on it.
void check_lists(const Valve &valve, Faults &faults);

// Names, ids, materials.
void check_parts(const Valve &valve, Faults &faults);

// Coordinates are numbers, in metres, in one place. The next two rely on it.
void check_places(const Valve &valve, Faults &faults);

// Triangles make one oriented, manifold sheet that hangs from the annulus and faces the atrium.
void check_sheet(const Valve &valve, const Sheet &sheet, Faults &faults);

// The annulus is a closed boundary loop.
void check_annulus(const Valve &valve, const Sheet &sheet, Faults &faults);

// Chordae lead from papillary heads to the sheet; every node belongs to something.
void check_chords(const Valve &valve, const Sheet &sheet, Faults &faults);

}  // namespace mvs::core
