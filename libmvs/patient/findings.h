// Adds findings to a list, finds them by name, and puts points into them.
#pragma once

#include <utility>

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// A finding measured on the surface.
inline void add_measured(Findings &findings, const char *name, std::string sentence,
                         std::vector<double> value, const char *unit) {
  findings.push_back(
      {name, FindingSource::measured, 1, std::move(sentence), std::move(value), unit});
}

// The first finding with a name; null: none.
inline const Finding *find_finding(const Findings &findings, const std::string &name) {
  for (const Finding &finding : findings) {
    if (finding.name == name) return &finding;
  }
  return nullptr;
}

inline Finding *find_finding(Findings &findings, const std::string &name) {
  return const_cast<Finding *>(find_finding(std::as_const(findings), name));
}

// Points (m) as the value of a finding: x, y, z in turn.
inline void set_points(const std::vector<Vec3> &points, Finding &finding) {
  finding.value.clear();
  for (const Vec3 &p : points) {
    finding.value.insert(finding.value.end(), {p.x(), p.y(), p.z()});
  }
  finding.unit = "m";
}
inline std::vector<Vec3> points_in(const Finding &finding) {
  std::vector<Vec3> points;
  for (size_t k = 0; k + 2 < finding.value.size(); k += 3) {
    points.emplace_back(finding.value[k], finding.value[k + 1], finding.value[k + 2]);
  }
  return points;
}

}  // namespace mvs::core
