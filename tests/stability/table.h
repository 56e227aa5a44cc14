// The result table of the suite: a row for each case on each valve in each solver mode, and the
// known failures.
#pragma once

#include <string>
#include <vector>

#include "tests/stability/watch.h"

namespace stability {

struct Row {
  std::string name, valve;
  SolverMode mode;
  Verdict verdict;
  double cpu_s;
};

// "passed", "FAILED", "known" (a failure that the README names) or "BETTER" (known, and passed).
std::string verdict_of(const Row &row);
// Why a case is known to fail; "" where it is not.
std::string known_reason(const Row &row);

void print_head();
void print(const Row &row);
void write_csv(const std::vector<Row> &rows, const std::string &path);

}  // namespace stability
