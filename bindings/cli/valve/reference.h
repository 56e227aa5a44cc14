// `mvs close --reference`: distances of a closed valve, and of every member of an
// ensemble, from a reference shape.
#pragma once

#include <vector>

#include "valve/ensemble.h"

namespace cli {

// Comparisons with a reference shape.
struct Errors {
  std::string file;
  mvs_comparison plain;
  std::vector<mvs_comparison> at_rest;  // of the members at rest; empty without an ensemble
};

// `reference` is the valve of `file`; `ensemble` is nullable.
Errors errors_from(const std::string &file, const mvs::Snapshot &reference,
                   const mvs::Snapshot &closed, const Ensemble *ensemble);

Json errors_json(const Errors &errors);
std::string errors_text(const Errors &errors);

}  // namespace cli
