// What callers add to a step of time by what they ask for, through include/mvs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace bench {

struct Part {
  std::string name;
  double on, off;  // CPU seconds
};

// Snapshots taken or not, measures asked for or not, levels of undo or none, over so many steps.
std::vector<Part> caller_parts(uint32_t vertices, int steps);

}  // namespace bench
