// `mvs close --reference`: distances of a closed valve, and of every member of an
// ensemble, from a reference shape.
#pragma once

#include <vector>

#include "ensemble.h"

namespace cli {

// The comparisons of all closures at rest with a reference, the plain one first.
struct Errors {
  std::string file;
  mvs_comparison plain;
  std::vector<mvs_comparison> at_rest;  // empty: one closure only
};

// `reference` is the valve of `file`; `ensemble` is null for one closure.
Errors errors_from(const std::string &file, const mvs::Snapshot &reference,
                   const mvs::Snapshot &closed, const Ensemble *ensemble);

Json errors_json(const Errors &errors);
std::string errors_text(const Errors &errors);

}  // namespace cli
