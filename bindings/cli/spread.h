// `mvs close --paths`: how far the closures of one valve lie apart.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "console.h"

namespace cli {

struct SpreadOptions {
  uint32_t paths = 0;  // 0: not asked for
  uint64_t seed = 0;
  double perturbation_mm = 0.5;
};

void add_spread_options(CLI::App &command, SpreadOptions &options);

// Closes the valve of a snapshot along all paths.
mvs::Spread spread_of(const mvs::Snapshot &start, double pressure_mmhg,
                      const mvs_settle_options &settle, const SpreadOptions &options,
                      uint32_t backend, Progress &progress);

Json spread_json(const mvs::Spread &spread, const SpreadOptions &options);

// All paths in short, the read-outs of the plain closure with their spread, and each path.
std::string spread_text(const mvs::Spread &spread);

}  // namespace cli
