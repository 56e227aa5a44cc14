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

// A value that a build found, guessed or assumed: mvs_finding, owned.
struct Finding {
  std::string name, sentence, unit;
  mvs_finding_source source = 0;
  double confidence = 0;
  std::vector<double> values;
  bool doubtful = false;
};

inline Finding finding_of(const mvs_findings *findings, std::uint32_t index) {
  const auto found = filled<mvs_finding>(mvs_findings_get, findings, index);
  Finding finding{found.name, found.sentence,     found.unit, found.source, found.confidence,
                  {},         found.doubtful != 0};
  finding.values.resize(found.values.count);
  if (!finding.values.empty()) {
    std::memcpy(finding.values.data(), found.values.data, sizeof(double) * found.values.count);
  }
  return finding;
}

// Copies findings, and releases them.
inline std::vector<Finding> take_findings(mvs_findings *findings) {
  struct Release {
    mvs_findings *findings;
    ~Release() { mvs_findings_release(findings); }
  } const release{findings};
  std::uint32_t count = 0;
  must(mvs_findings_get_count(findings, &count));
  std::vector<Finding> taken;
  for (std::uint32_t k = 0; k < count; ++k) taken.push_back(finding_of(findings, k));
  return taken;
}

// Replaces the valve of `sim`; returns the findings.
inline std::vector<Finding> build_valve(Simulator &sim, mvs_surface_desc surface,
                                        mvs_build_options options = {}) {
  surface.struct_size = sizeof surface;
  options.struct_size = sizeof options;
  mvs_findings *findings = nullptr;
  must(mvs_build_valve(sim.get(), &surface, &options, &findings));
  return take_findings(findings);
}

// Closes the valve of `sim` with other lengths and thicknesses; returns its leak and the interval.
inline std::vector<Finding> find_leak_interval(Simulator &sim, mvs_leak_errors errors = {}) {
  errors.struct_size = sizeof errors;
  mvs_findings *findings = nullptr;
  must(mvs_find_leak_interval(sim.get(), &errors, &findings));
  return take_findings(findings);
}

}  // namespace mvs

#endif
