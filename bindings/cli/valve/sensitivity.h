// Derivatives of measures of a valve in the units of the command.
#pragma once

#include <string>
#include <vector>

#include "text/console.h"

namespace cli {

struct AskedQuantity {
  std::string label;  // as given: "coaptation"
  std::string name;   // of the measure
  std::string unit;   // shown: "mm2"
  double scale;       // from SI
};

struct AskedParameters {
  std::vector<std::string> names;
  std::vector<mvs_parameter> list;
  std::string unit;  // of a change: "mm"
  double scale;      // SI per unit
};

struct SensitivityTable {
  std::vector<AskedQuantity> quantities;
  AskedParameters parameters;
  // In shown units; a row a quantity. `above`, `below`: for a growing and a falling parameter; NaN
  // where more than 64 places are about to switch.
  std::vector<double> value, derivative, above, below;
  std::vector<mvs_sensitivity_notes> quantity_notes, parameter_notes;
  mvs_sensitivity_summary summary;

  size_t index(size_t q, size_t p) const { return q * parameters.names.size() + p; }
};

// Values of --to.
std::vector<std::string> parameter_words();

// Measures by their names, or "coaptation" and "orifice". `chord`: the only one whose parameters
// are asked for; empty: all.
SensitivityTable sensitivity_table(const mvs::Snapshot &valve, const std::vector<std::string> &of,
                                   const std::string &to, const std::string &chord);

// Words of MVS_SENSITIVITY_NOTE_*.
std::vector<std::string> note_words(mvs_sensitivity_notes notes);

}  // namespace cli
