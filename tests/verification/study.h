// A study of the verification suite: values that libmvs computes beside exact ones, on finer and
// finer meshes, with the source of the exact values and the expected order of convergence.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mvs::core::verification {

// Rows of one name and one x are a series, coarse to fine.
struct Row {
  std::string name;
  double x = 0;      // where on a curve: a strain, a radius, a load; in the unit of Study::x
  double level = 0;  // m, mean edge length; s for steps in time; 0: exact on any mesh
  double value = 0;
  double exact = 0;
  double scale = 0;  // what the error is relative to; 0: to the exact value itself

  double error() const;
};

struct Study {
  std::string name;      // of its table
  std::string title;     // in words
  std::string quantity;  // what value and exact are, with the unit
  std::string x;         // the meaning of x, with the unit; empty: unused
  std::string level;     // "edge, m" or "step, s"; empty: no levels
  std::string source;    // of the exact values
  std::string expects;   // the order, and why
  double tolerance = 0;  // of the error on the finest level; 0: reported, nothing asked
  double order_low = 0;  // of the two finest levels; both 0: nothing asked
  double order_high = 0;
  std::vector<Row> rows;
};

// The observed order at row k: from the row of its series before it. NaN for the first of a series
// and where the error is rounding.
double order_at(const Study &study, size_t k);
bool is_finest(const Study &study, size_t k);
double worst_error(const Study &study);  // over the finest levels
// Over the finest levels of all series; NaN without levels.
std::pair<double, double> order_range(const Study &study);

// Empty if the study meets its expectations, otherwise one sentence for each fault.
std::vector<std::string> faults(const Study &study);

// DIR/<name>.csv of every study, and DIR/studies.csv about them.
void write_tables(const std::vector<Study> &studies, const std::filesystem::path &folder);
std::string as_text(const Study &study);

// Whether the long runs are asked for (MVS_TEST_LONG).
bool long_runs();

// The suite, by subject.
std::vector<Study> law_studies();
std::vector<Study> shear_studies();
std::vector<Study> patch_studies();
std::vector<Study> disc_studies();
std::vector<Study> laplace_studies();
std::vector<Study> buckling_studies();
std::vector<Study> cable_studies();
std::vector<Study> bending_studies();
std::vector<Study> step_studies();

}  // namespace mvs::core::verification
