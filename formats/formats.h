// Files to a valve with its state, and back. One file a format; FORMAT.md describes them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "history/history.h"

namespace mvs::core {

// What a file holds.
struct Loaded {
  Valve valve;
  State state;
};

// Files above this size are refused.
inline constexpr size_t max_file_bytes = size_t{1} << 30;

// Extended OBJ. Reading is strict: MVS_E_FORMAT with the line, or MVS_E_VERSION. What it returns
// has indices in range and finite numbers, and may leave out what make_model completes.
Loaded read_obj(std::string_view text);
std::string write_obj(const Model &model, const State &state);

// Abaqus input (.inp): the valve of its shells and trusses, at rest, with the load that it ends
// with set. MVS_E_FORMAT with the line. What the file has and a valve has not is in the notes, and
// what had to be chosen.
struct Note {
  mvs_log_level level;  // MVS_LOG_WARNING: left out or chosen; MVS_LOG_INFO: a count
  std::string text;
};
struct Imported {
  Loaded loaded;
  std::vector<Note> notes;
};
Imported read_inp(std::string_view text);

// A FEBio 4.0 model that closes the valve from its rest shape, under the pressure of the state (120
// mmHg where it has none). MVS_E_UNSUPPORTED for a law that FEBio cannot express.
std::string write_feb(const Model &model, const State &state);

// VTK XML PolyData with the point and cell arrays of FORMAT.md. `arrays` is made by the caller, so
// that this layer needs no physics.
struct VtpArray {
  std::string name;
  bool on_points = true;
  int components = 1;
  std::vector<double> values;  // points: all nodes; cells: triangles, then chords (NaN: not there)
};
std::string write_vtp(const Model &model, const State &state, const std::vector<VtpArray> &arrays);

// HDF5: a valve with its state and all of its history, and the present for VTK in the same file,
// with `arrays` as above. What levels of the history share is shared in the file and again when
// read. MVS_E_UNSUPPORTED in a build without HDF5.
std::string write_session(const Snapshot &snapshot, const std::vector<VtpArray> &arrays);
Snapshot read_session(std::string_view bytes);

// Reads a file or pipe of at most `limit` bytes.
std::string read_whole_file(const std::string &path, size_t limit = max_file_bytes);

// Writes beside the target, to the disk, and renames: at every moment, also when the machine loses
// power, the target is either the old file or the whole new one. A failure leaves nothing behind.
void write_whole_file(const std::string &path, std::string_view bytes);

}  // namespace mvs::core
