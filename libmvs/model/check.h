// Is this a valve? Every reason why not, in words.
#pragma once

#include <functional>
#include <string>

#include "model/valve.h"

namespace mvs::core {

struct Fault {
  std::string part;      // "triangle 17"
  std::string sentence;  // what is wrong with it and what to do
};

// Lists every fault of a valve, in the order of its parts; an empty list is a valve.
std::vector<Fault> find_faults(const Valve &valve);

// Turns triangles so that neighbours agree and normals point into the atrium.
void orient(Valve &valve);

}  // namespace mvs::core
