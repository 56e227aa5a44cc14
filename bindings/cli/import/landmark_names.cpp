#include "import/landmark_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>

namespace cli {
namespace {

enum class Side { unknown, anterolateral, posteromedial };

// The side in a name, such as "AL", "AL1", "pm tip" or "anterolateral".
Side side_of(std::string name) {
  for (char &c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto says = [&](const char *letters, const char *word) {
    const bool is_short =
        name.starts_with(letters) &&
        (name.size() == 2 || std::isalpha(static_cast<unsigned char>(name[2])) == 0);
    return is_short || name.find(word) != std::string::npos;
  };
  if (says("al", "anterolat")) return Side::anterolateral;
  return says("pm", "posteromed") ? Side::posteromedial : Side::unknown;
}

// The commissures of the findings, the anterolateral one first: their middle and the way to the
// posteromedial one.
struct Sides {
  std::array<double, 3> middle{}, way{};
  bool is_known = false;

  explicit Sides(const std::vector<mvs::Finding> &findings) {
    const auto found =
        std::find_if(findings.begin(), findings.end(), [](const mvs::Finding &finding) {
          return finding.name == "commissures" && finding.values.size() == 6;
        });
    if (found == findings.end()) return;
    for (size_t k = 0; k < 3; ++k) {
      middle[k] = 0.5 * (found->values[k] + found->values[3 + k]);
      way[k] = found->values[3 + k] - found->values[k];
    }
    is_known = true;
  }
  Side of(const double *point) const {
    double along = 0;
    for (size_t k = 0; k < 3; ++k) along += way[k] * (point[k] - middle[k]);
    return along > 0 ? Side::posteromedial : Side::anterolateral;
  }
};

}  // namespace

void warn_of_names(const PatientFiles &files, const std::vector<std::string> &paths,
                   const std::vector<mvs::Finding> &findings) {
  const Sides sides(findings);
  if (!sides.is_known) return;
  for (const std::string &path : paths) {
    if (path.empty()) continue;
    const std::vector<std::string> names = files.file(path).names();
    const std::vector<double> points = files.points(path);
    std::string others;
    for (size_t k = 0; k < names.size(); ++k) {
      const Side said = side_of(names[k]);
      if (said == Side::unknown || said == sides.of(&points[3 * k])) continue;
      others += (others.empty() ? "\"" : ", \"") + names[k] + "\"";
    }
    if (others.empty()) continue;
    std::fprintf(
        stderr,
        "mvs: warning: %s: on the other side of the valve than their names say (AL: "
        "anterolateral, PM: posteromedial): %s. Are names swapped, is the case mirrored, or are "
        "they in the other frame (LPS or RAS)? Scallops 1 and 3 depend on it\n",
        path.c_str(), others.c_str());
  }
}

}  // namespace cli
