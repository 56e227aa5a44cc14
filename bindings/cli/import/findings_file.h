// The file of findings that `mvs import` writes beside a valve, and reads back by --with.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "text/console.h"

namespace cli {

// Findings in SI units with all digits, so that a value read back is the same.
Json findings_json(const std::vector<mvs::Finding> &findings);

// A table: name, source, confidence, sentence.
std::string findings_text(const std::vector<mvs::Finding> &findings);

// Writes beside, then renames.
void write_findings(const std::string &path, const std::string &surface,
                    const std::vector<mvs::Finding> &findings);

// Values for a build. Empty: not known.
struct KnownValues {
  std::vector<double> annulus, commissures, anterior, papillary_tips;  // points, x, y, z in turn, m
  std::vector<double> closed_annulus, closed_tips;                     // the same
  std::vector<double> thickness, edge_error, edge_lost;                // one each, m
  std::vector<double> thickness_error, closed_error;                   // the same
  std::vector<double> tissue;                                          // one, MVS_LEAFLET_LAW_*
  // guesses and assumptions of the file with unedited values, by name
  std::map<std::string, mvs::Finding> unsure;
  std::vector<std::string> ignored;  // names of edited findings that are no values for a build
};

// The values of a file of findings that are given, guessed or assumed. Measured ones are left out,
// as the build measures them again; a source that is changed to "given" counts.
KnownValues read_findings(const std::string &path);

// Whether a finding is an input of a build.
bool is_input(const std::string &name);

// A value that was read back as it was found is as sure as it was found: gives such findings of a
// build that takes it for given their source, confidence and doubt.
void keep_doubts(const KnownValues &known, std::vector<mvs::Finding> &findings);

}  // namespace cli
