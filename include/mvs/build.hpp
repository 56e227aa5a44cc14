// Valves from surfaces for C++17. Part of mvs/experimental.hpp.
#ifndef MVS_BUILD_HPP
#define MVS_BUILD_HPP

#include <mvs/build.h>
#include <mvs/mvs.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace mvs {

// A value that a build found, guessed or assumed: mvs_build_finding, owned.
struct BuildFinding {
  std::string name, sentence, unit;
  mvs_finding_source source = 0;
  double confidence = 0;
  std::vector<double> values;
  bool doubtful = false;
};

inline BuildFinding build_finding(const mvs_build *build, std::uint32_t index) {
  const auto found = filled<mvs_build_finding>(mvs_build_get_finding, build, index);
  BuildFinding finding{found.name, found.sentence,     found.unit, found.source, found.confidence,
                       {},         found.doubtful != 0};
  finding.values.resize(found.values.count);
  if (!finding.values.empty()) {
    std::memcpy(finding.values.data(), found.values.data, sizeof(double) * found.values.count);
  }
  return finding;
}

// The findings of a build, which is released.
inline std::vector<BuildFinding> take_findings(mvs_build *build) {
  struct Release {
    mvs_build *build;
    ~Release() { mvs_build_release(build); }
  } const release{build};
  std::uint32_t count = 0;
  must(mvs_build_get_finding_count(build, &count));
  std::vector<BuildFinding> findings;
  for (std::uint32_t k = 0; k < count; ++k) findings.push_back(build_finding(build, k));
  return findings;
}

// Replaces the valve of `sim`; returns the findings.
inline std::vector<BuildFinding> build_valve(Simulator &sim, mvs_surface_desc surface,
                                             mvs_build_options options = {}) {
  surface.struct_size = sizeof surface;
  options.struct_size = sizeof options;
  mvs_build *build = nullptr;
  must(mvs_build_valve(sim.get(), &surface, &options, &build));
  return take_findings(build);
}

// Closes the valve of `sim` with other lengths and thicknesses; returns its leak and the interval.
inline std::vector<BuildFinding> find_leak_interval(Simulator &sim, mvs_leak_errors errors = {}) {
  errors.struct_size = sizeof errors;
  mvs_build *found = nullptr;
  must(mvs_find_leak_interval(sim.get(), &errors, &found));
  return take_findings(found);
}

}  // namespace mvs

#endif
