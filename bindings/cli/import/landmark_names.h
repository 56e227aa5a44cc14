// Names of landmarks, AL and PM, beside the sides on which a build has found them.
#pragma once

#include "import/landmarks.h"

namespace cli {

// Warns on stderr of points of these files whose names say the other side of the valve than the
// commissures of the findings: swapped names, a mirrored case, or another frame. Files without a
// path are left out.
void warn_of_names(const PatientFiles &files, const std::vector<std::string> &paths,
                   const std::vector<mvs::Finding> &findings);

}  // namespace cli
