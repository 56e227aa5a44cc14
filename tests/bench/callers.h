// Cost that an application's optional calls add to a step of time, through include/mvs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace bench {

struct Part {
  std::string name;
  double on, off;  // CPU seconds
};

// With and without snapshots, measures and levels of undo, over so many steps.
std::vector<Part> caller_parts(uint32_t vertices, int steps);

}  // namespace bench
