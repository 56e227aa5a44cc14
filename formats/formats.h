// Files to a valve with its state, and back. One file a format; FORMAT.md describes them.
#pragma once

#include <string>
#include <string_view>

#include "model/model.h"

namespace mvs {

// What a file holds.
struct Loaded {
  Valve valve;
  State state;
};

// Extended OBJ. Reading is strict: MVS_E_FORMAT with the line, or MVS_E_VERSION.
Loaded read_obj(std::string_view text);
std::string write_obj(const Model &model, const State &state);

// VTK XML PolyData with the point and cell arrays of FORMAT.md. `arrays` is made by the caller, so
// that this layer needs no physics.
struct VtpArray {
  std::string name;
  bool on_points = true;
  int components = 1;
  std::vector<double> values;  // points: all nodes; cells: triangles, then chords (NaN: not there)
};
std::string write_vtp(const Model &model, const State &state, const std::vector<VtpArray> &arrays);

// Whole files: reading with a size limit, writing beside the target and renaming.
std::string read_whole_file(const std::string &path);
void write_whole_file(const std::string &path, std::string_view bytes);

}  // namespace mvs
