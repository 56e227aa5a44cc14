// Validation of a valve: returns every fault with a sentence for the user.
#pragma once

#include <functional>
#include <string>

#include "model/valve.h"

namespace mvs::core {

struct Fault {
  std::string part;      // "triangle 17"
  std::string sentence;  // the fault and its remedy
};

// Returns every fault of a valve, in the order of its parts; empty for a valid valve.
std::vector<Fault> find_faults(const Valve &valve);

// The same for a valve whose mesh is that of a valid one: checks lists, names, ids and constants.
std::vector<Fault> find_faults_beside_mesh(const Valve &valve);

// Reorders triangle corners so that neighbours have the same winding and normals point into the
// atrium.
void orient(Valve &valve);

}  // namespace mvs::core
