// Input of `mvs import`: surface, landmarks and known values from files, as the description of a
// build.
#pragma once

#include <string>
#include <vector>

#include "import/findings_file.h"
#include "import/landmarks.h"

namespace cli {

struct ImportOptions {
  std::string surface, out, findings_out, with;
  std::string annulus, commissures, anterior, tips, closed, closed_annulus, closed_tips;
  bool no_leak = false;
  std::string kind, leaflet, label_array, thickness_array;
  FileOptions files;
  double edge = 0, thickness = 0, coaptation_length = 0;                        // mm
  double edge_error = 0, edge_lost = 0, thickness_error = 0, closed_error = 0;  // mm
  mvs_build_options build = {};
};

// Input of a build, with the memory that the description points to.
struct ImportInput {
  PatientFiles files;
  std::vector<double> points, annulus, commissures, anterior, tips, thickness, closed;
  std::vector<double> closed_annulus, closed_tips;
  std::vector<uint32_t> labels;
};

// Reads the files. `known`, the values of --with, go to `with_known`, where no option gives them;
// those that an option gives are no longer known.
ImportInput read_input(const ImportOptions &options, ImportOptions &with_known, KnownValues &known);

// Points to the memory of the input and of the name.
mvs_surface_desc desc_of(const ImportInput &input, const ImportOptions &options,
                         const std::string &name);

}  // namespace cli
