// Adds findings to a list.
#pragma once

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// A finding measured on the surface.
inline void add_measured(Findings &findings, const char *name, std::string sentence,
                         std::vector<double> value, const char *unit) {
  findings.push_back(
      {name, FindingSource::measured, 1, std::move(sentence), std::move(value), unit});
}

}  // namespace mvs::core
