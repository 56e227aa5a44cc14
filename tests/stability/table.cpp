#include "tests/stability/table.h"

#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "tests/stability/known.h"

namespace stability {
namespace {

std::string joined(const std::vector<std::string> &texts) {
  std::string all;
  for (const std::string &text : texts) all += (all.empty() ? "" : "; ") + text;
  return all;
}

std::string rest_of(const Row &row) {
  if (row.verdict.moves == 0) return "refused";
  return row.verdict.at_rest ? "yes" : "no";
}

std::string note_of(const Row &row) {
  const std::string faults = joined(row.verdict.faults);
  return faults.empty() ? row.verdict.sentence : faults;
}

}  // namespace

std::string known_reason(const Row &row) {
  for (const Known &k : known_failures) {
    if (k.name == row.name && (!*k.mode || std::strcmp(k.mode, name_of(row.mode)) == 0)) {
      return k.reason;
    }
  }
  return "";
}

std::string verdict_of(const Row &row) {
  if (known_reason(row).empty()) return row.verdict.passed() ? "passed" : "FAILED";
  return row.verdict.passed() ? "BETTER" : "known";
}

void print_head() {
  std::printf("%-32s %-5s %-8s %6s %8s %9s %5s %10s %-7s %7s  %-6s\n", "case", "valve", "mode",
              "moves", "made", "gained J", "cross", "residual N", "at rest", "cpu s", "");
}

void print(const Row &row) {
  const Verdict &v = row.verdict;
  std::printf("%-32s %-5s %-8s %6u %8.0e %9.1e %5zu %10.1e %-7s %7.2f  %-6s %s\n", row.name.c_str(),
              row.valve.c_str(), name_of(row.mode), v.moves, v.made, v.gained, v.crossed,
              v.residual, rest_of(row).c_str(), row.cpu_s, verdict_of(row).c_str(),
              note_of(row).c_str());
  std::fflush(stdout);
}

void write_csv(const std::vector<Row> &rows, const std::string &path) {
  std::ofstream file(path);
  file << "case,valve,mode,moves,made,gained_J,crossed,residual_N,at_rest,refused,cpu_s,verdict,"
          "note\n";
  for (const Row &row : rows) {
    const Verdict &v = row.verdict;
    file << row.name << ',' << row.valve << ',' << name_of(row.mode) << ',' << v.moves << ','
         << v.made << ',' << v.gained << ',' << v.crossed << ',' << v.residual << ','
         << rest_of(row) << ',' << v.refused << ',' << row.cpu_s << ',' << verdict_of(row) << ",\""
         << note_of(row) << "\"\n";
  }
  if (!file.flush()) throw std::runtime_error("could not write " + path);
}

}  // namespace stability
