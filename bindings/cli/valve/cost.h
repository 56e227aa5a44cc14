// Cost of the repair of a closed valve (mvs_snapshot_measure_cost), for commands that report it.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <string>
#include <vector>

#include "text/console.h"

namespace cli {

struct CostOptions {
  double diastole_mmhg = 5;
  double flow_ml_s = 0;  // 0: not known
  std::string septum;    // file with its points, in mm; "": not known
};

std::array<CLI::Option *, 3> add_cost_options(CLI::App &command, CostOptions &options);

// Measures costs with the options of a command; the file of the septum is read once.
class CostMeter {
 public:
  explicit CostMeter(const CostOptions &options);
  // The options in words: "diastole 5 mmHg, flow 250 ml/s", of the septum also a hash of the file.
  const std::string &words() const { return words_; }
  mvs::Cost of(const mvs::Snapshot &closed, Progress *progress = nullptr) const;

 private:
  mvs_cost_options options_ = {};
  std::vector<std::array<double, 3>> septum_;
  std::string words_;
};

}  // namespace cli
