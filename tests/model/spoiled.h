// Fixture: a fault made on purpose in the small valve, and the sentences that the checks report.
#pragma once

#include <doctest/doctest.h>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "model/checks/check.h"
#include "tests/model/small_valve.h"

namespace mvs::core::spoiled {

inline const double not_a_number = std::numeric_limits<double>::quiet_NaN();
// The first node of the free edge.
inline constexpr uint32_t edge_row = (small_rows - 1) * small_segments;
// The first of two heads, then its branch.
inline constexpr uint32_t head = small_rows * small_segments;

// The faults after `spoil`, one a line, for messages of failing tests.
inline std::string faults_after(const std::function<void(Valve &)> &spoil, size_t *count) {
  Valve valve = small_valve();
  spoil(valve);
  std::string text;
  const std::vector<Fault> faults = find_faults(valve);
  *count = faults.size();
  for (const Fault &fault : faults) text += fault.part + ": " + fault.sentence + "\n";
  return text;
}

inline void check_fault(const char *wanted, size_t wanted_count,
                        const std::function<void(Valve &)> &spoil) {
  size_t count = 0;
  const std::string text = faults_after(spoil, &count);
  CAPTURE(text);
  CAPTURE(wanted);
  CHECK(count == wanted_count);
  CHECK(text.find(wanted) != std::string::npos);
}

}  // namespace mvs::core::spoiled
