// The grid of a sweep: operations whose fields have lists of values, and all their combinations.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "text/op_text.h"

namespace cli {

// A field of an operation with its values; their text has the form that OpText reads.
struct SweepAxis {
  mvs_field_info field;
  std::vector<std::string> values;
};

struct SweepOp {
  mvs::OpKind kind;
  std::vector<SweepAxis> axes;
};

// Reads "ring size=28:36:2" or "chord-length chord=A2/7 factor=0.7,0.8,0.9". A number may be a
// range FIRST:LAST:STEP; values are separated by commas, points by semicolons. Throws
// std::invalid_argument with a sentence.
SweepOp read_sweep_op(const std::string &text);

class SweepGrid {
 public:
  // Throws std::invalid_argument for more than 100,000 combinations. Reads the files of points,
  // each once; throws mvs::Error if one cannot be read.
  explicit SweepGrid(std::vector<SweepOp> ops);

  size_t combinations() const { return count_; }
  // "ring_size_mm", one for each axis; "chord_length_2_factor" in the second operation of a kind.
  std::vector<std::string> columns() const;
  // Whether the values of each column are numbers, in the order of columns().
  std::vector<bool> has_numbers() const;
  // The values of a combination in the order of columns(); the last axis changes fastest.
  std::vector<std::string> values(size_t combination) const;
  // Whether a field has files of points.
  bool has_files() const { return !files_.empty(); }
  // Hashes of the contents of a combination's files, in the order of columns(), with blanks
  // between.
  std::string files(size_t combination) const;
  // Applies the operations of a combination, in the order in which they were given.
  void apply(size_t combination, mvs::Simulator &sim) const;

 private:
  std::vector<SweepOp> ops_;
  size_t count_ = 1;
  std::map<std::string, PointsFile> files_;  // by their names
};

}  // namespace cli
