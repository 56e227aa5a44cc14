// Findings about the leak of a built valve.
#pragma once

#include "patient/fit/leak_interval.h"

namespace mvs::core {

// m2, by which meshes of one valve differ: a valve with less is sealed.
inline constexpr double sealed_leak = 0.5e-6;

// Adds the findings "leak", "leak_interval" and "leak_limits": by how much meshes of one valve
// differ, and the width at which an interval says nothing. The second has no values if too few
// closures came to rest (leak_interval.h), and "leak_at_rest" says so if fewer than half did. None
// is surer than the fit to a closed surface.
void report_leaks(const LeakInterval &interval, const EdgeRange &edge, double thickness_error,
                  Findings &findings);

}  // namespace mvs::core
