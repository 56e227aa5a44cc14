// `mvs close --members`: an ensemble of closures of one valve and the distances between its
// members.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "text/console.h"

namespace cli {

using Ensemble = mvs::Ensemble;

struct EnsembleOptions {
  uint32_t members = 0;  // 0: no ensemble
  uint64_t seed = 0;
  double perturbation_mm = 0.5;
};

void add_ensemble_options(CLI::App &command, EnsembleOptions &options);

// Closes the valve of a snapshot once per member.
Ensemble run_ensemble(const mvs::Snapshot &start, double pressure_mmhg,
                      const mvs_settle_options &settle, const EnsembleOptions &options,
                      uint32_t backend, Progress &progress);

Json ensemble_json(const Ensemble &ensemble, const EnsembleOptions &options);

// The summary, the read-outs of member 0 with their range, and one line per member.
std::string ensemble_text(const Ensemble &ensemble);

}  // namespace cli
