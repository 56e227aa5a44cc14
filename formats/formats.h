// Readers and writers of a valve with its state, one file per format; FORMAT.md defines the
// formats.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "history/history.h"

namespace mvs::core {

// The content of a file.
struct Loaded {
  Valve valve;
  State state;
};

// Files above this size are refused.
inline constexpr size_t max_file_bytes = size_t{1} << 30;

// Extended OBJ. The reader is strict: MVS_E_FORMAT with the line, or MVS_E_VERSION. It returns
// indices in range and finite numbers, and leaves defaults to make_model.
Loaded read_obj(std::string_view text);
std::string write_obj(const Model &model, const State &state);

// Abaqus input (.inp): a valve of its shells and trusses, at rest, with the final load of the file
// set. MVS_E_FORMAT with the line. The notes list ignored features and assumptions.
struct Note {
  mvs_log_level level;  // MVS_LOG_WARNING: ignored or assumed; MVS_LOG_INFO: a count
  std::string text;
};
struct Imported {
  Loaded loaded;
  std::vector<Note> notes;
};
Imported read_inp(std::string_view text);

// FEBio 4.0 model that closes the valve from its rest shape, under the pressure of the state (120
// mmHg if that is 0). MVS_E_UNSUPPORTED for a law that FEBio cannot express.
std::string write_feb(const Model &model, const State &state);

// VTK XML PolyData with the point and cell arrays of FORMAT.md. The caller computes `arrays`, so
// that this layer is independent of the physics.
struct VtpArray {
  std::string name;
  bool on_points = true;
  int components = 1;
  std::vector<double> values;  // points: all nodes; cells: triangles, then chords (0: not there)
};
std::string write_vtp(const Model &model, const State &state, const std::vector<VtpArray> &arrays);

// VTK XML multiblock dataset: an index and one VTP file for each block. Returns the files in the
// order to write them, the index last, with paths relative to the folder of the index: for the stem
// "closed" closed/valve.vtp, closed/BLOCK.vtp ..., closed.vtm.
struct VtkBlock {
  std::string name;          // letters, digits, underscores
  std::vector<Vec3> points;  // m
  std::vector<Edge> lines;
  std::vector<Tri> triangles;
  std::vector<VtpArray> arrays;
  std::vector<std::pair<std::string, double>> numbers;  // of the whole block
};
struct NamedFile {
  std::string path, bytes;
};
std::vector<NamedFile> write_vtm(const std::string &stem, const Model &model, const State &state,
                                 const std::vector<VtpArray> &arrays,
                                 const std::vector<VtkBlock> &blocks);

// HDF5: a valve with its state and history, and its present shape for VTK in the same file, with
// `arrays` as above. Data shared by levels of the history is stored once and shared after reading.
// MVS_E_UNSUPPORTED in a build without HDF5.
std::string write_session(const Snapshot &snapshot, const std::vector<VtpArray> &arrays);
Snapshot read_session(std::string_view bytes);

// Reads a file or pipe of at most `limit` bytes.
std::string read_whole_file(const std::string &path, size_t limit = max_file_bytes);

// Creates a folder; false if it is there.
bool make_folder(const std::string &path);
void remove_empty_folder(const std::string &path);

// Replaces a file atomically: at every moment, also after a power loss, the target is either the
// old file or the whole new one. A failure removes the temporary file.
void write_whole_file(const std::string &path, std::string_view bytes);
// The same for files in a folder (their paths are relative to it; "": the present one). All are
// written before the first takes the place of its target.
void write_whole_files(const std::vector<NamedFile> &files, const std::string &folder);

}  // namespace mvs::core
