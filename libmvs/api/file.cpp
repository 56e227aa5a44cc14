// Loads and saves files and memory in all formats; the ending or the caller selects the format.
#include <mvs/file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "api/sim_call.h"
#include "formats/formats.h"
#include "formats/obj/part_line.h"
#include "formats/surface/cursor.h"
#include "formats/text/xml.h"
#include "session/simulator.h"
#include "solve/rest_claim.h"

using namespace mvs::core;

namespace {

const char *const read_endings =
    "known endings are .obj, .h5, .vtkhdf, .vtp, .vtm, .inp and .feb, or name the format";
const char *const written_endings =
    "known endings are .obj, .h5, .vtkhdf, .vtp, .vtm and .feb, or name the format";

uint32_t checked_format(uint32_t format_given) {
  MVS_MUST(format_given <= MVS_FORMAT_VTM, MVS_E_ARGUMENT, "format",
           "format is %u: it has to be one of MVS_FORMAT_*", format_given);
  return format_given;
}

uint32_t format_of(const char *path, uint32_t format_given, const char *endings) {
  must_point(path, "path");
  MVS_MUST(*path, MVS_E_ARGUMENT, "path", "the path is empty");
  if (checked_format(format_given) != MVS_FORMAT_AUTO) return format_given;
  const std::string small = in_small_letters(path);
  if (small.ends_with(".obj")) return MVS_FORMAT_OBJ;
  if (small.ends_with(".vtp")) return MVS_FORMAT_VTP;
  if (small.ends_with(".vtm")) return MVS_FORMAT_VTM;
  if (small.ends_with(".h5") || small.ends_with(".vtkhdf")) return MVS_FORMAT_H5;
  if (small.ends_with(".inp")) return MVS_FORMAT_INP;
  if (small.ends_with(".feb")) return MVS_FORMAT_FEB;
  fail(MVS_E_ARGUMENT, "path", "the ending names no known format: %s", endings);
}

void load_inp(mvs_sim &sim, std::string_view bytes) {
  Imported imported = read_inp(bytes);
  ModelPtr model = make_model(std::move(imported.loaded.valve));
  for (const Note &note : imported.notes) sim.log(note.level, "%s", note.text.c_str());
  replace_valve(sim, {{std::move(model), std::move(imported.loaded.state)}, {}});
}

// A file that people edit may still say that its state is at rest.
void check_rest(const mvs_sim &sim, const Model &model, State &state) {
  const std::string fault = fault_of_rest(model, state);
  if (fault.empty()) return;
  sim.log(MVS_LOG_WARNING,
          "the file says that its valve is at rest within %g N, but %s: it counts as not at rest, "
          "settle it",
          state.rest_tolerance, fault.c_str());
  state.rest_tolerance = 0;
}

void load_session(mvs_sim &sim, std::string_view bytes) {
  // no memory for it fails the call before the valve is another one
  std::erase_if(sim.file_starts, [](const auto &start) { return start.expired(); });
  sim.file_starts.reserve(sim.file_starts.size() + 1);
  replace_valve(sim, read_session(bytes));
  if (sim.history_start()) sim.file_starts.push_back(sim.history_start());
}

void load_obj(mvs_sim &sim, std::string_view bytes) {
  Loaded loaded = read_obj(bytes);
  ModelPtr model;
  try {
    model = make_model(std::move(loaded.valve), sim.model());
  } catch (const Error &error) {
    throw with_line_of_part(error, bytes);
  }
  check_rest(sim, *model, loaded.state);
  replace_valve(sim, {{std::move(model), std::move(loaded.state)}, {}});
}

void load_bytes(mvs_sim &sim, std::string_view bytes, uint32_t format_given) {
  MVS_MUST(format_given != MVS_FORMAT_VTP && format_given != MVS_FORMAT_VTM, MVS_E_UNSUPPORTED,
           "format",
           "VTP and VTM files are written for other programs, not read: load the OBJ or HDF5 file");
  MVS_MUST(format_given != MVS_FORMAT_FEB, MVS_E_UNSUPPORTED, "format",
           "FEBio models are written for FEBio, not read: load the OBJ or HDF5 file");
  if (format_given == MVS_FORMAT_H5) return load_session(sim, bytes);
  if (format_given == MVS_FORMAT_INP) return load_inp(sim, bytes);
  load_obj(sim, bytes);
}

// Returns a cell array of a VTP file, whose cells are the triangles, then the chordae. Cells
// without a value have 0 (colour bars of viewers break on NaN and infinity); `chord_kind` tells
// them apart.
VtpArray triangle_array(const mvs_snapshot &s, const char *name, int components,
                        const double *values) {
  const size_t triangles = s.model->valve.triangles.size(), chords = s.model->valve.chords.size();
  VtpArray array{name, false, components, {}};
  array.values.assign(values, values + components * triangles);
  array.values.resize(components * (triangles + chords), 0.0);
  return array;
}

VtpArray chord_array(const mvs_snapshot &s, const char *name, const std::vector<double> &values) {
  VtpArray array{name, false, 1, {}};
  array.values.assign(s.model->valve.triangles.size(), 0.0);
  array.values.insert(array.values.end(), values.begin(), values.end());
  return array;
}

VtpArray point_array(const char *name, int components, const double *values, size_t count) {
  return {name, true, components, std::vector<double>(values, values + components * count)};
}

// The distance to the facing tissue in mm, and whether a node faces any: 0 and 0 if not.
std::array<VtpArray, 2> coaptation_arrays(const mvs_snapshot &s) {
  std::array<VtpArray, 2> made = {VtpArray{"coaptation_distance_mm", true, 1, {}},
                                  VtpArray{"faces_tissue", true, 1, {}}};
  for (const double distance : s.coaptation().distance) {
    const bool faces = std::isfinite(distance);
    made[0].values.push_back(faces ? 1e3 * distance : 0);
    made[1].values.push_back(faces ? 1 : 0);
  }
  return made;
}

std::vector<VtpArray> result_arrays(const mvs_snapshot &s) {
  const size_t n = s.model->node_count();
  auto [distance, faces] = coaptation_arrays(s);
  return {point_array("force_N", 3, s.forces().total.data()->data(), n),
          point_array("contact_force_N", 3, s.forces().contact.data()->data(), n),
          std::move(distance),
          std::move(faces),
          triangle_array(s, "stretch", 2, s.strain().stretch.data()->data()),
          triangle_array(s, "stress_Pa", 2, s.strain().stress.data()->data()),
          triangle_array(s, "strain_fibre", 3, s.tensors().strain.data()->data()),
          triangle_array(s, "stress_fibre_Pa", 3, s.tensors().stress.data()->data()),
          triangle_array(s, "stretch_direction", 3, s.tensors().direction.data()->data()),
          point_array("node_strain_fibre", 3, s.tensors().node_strain.data()->data(), n),
          point_array("node_stress_fibre_Pa", 3, s.tensors().node_stress.data()->data(), n),
          triangle_array(s, "coapted_share", 1, s.coaptation().share.data()),
          chord_array(s, "chord_strain", s.chords().strain),
          chord_array(s, "chord_tension_N", s.chords().tension)};
}

VtkBlock orifice_block(const mvs_snapshot &s) {
  const Orifice &orifice = s.orifice();
  VtkBlock block{"orifice", orifice.vertices, {}, orifice.triangles, {}, {}};
  VtpArray part{"orifice_part", false, 1, {}};
  for (const uint32_t index : s.orifice_parts().of_triangle) part.values.push_back(index);
  block.arrays.push_back(std::move(part));
  block.numbers = {{"regurgitant_orifice_area_mm2", 1e6 * orifice.area}};
  return block;
}

VtkBlock coaptation_block(const mvs_snapshot &s) {
  const Coaptation &coaptation = s.coaptation();
  VtkBlock block;
  block.name = "coaptation_line";
  VtpArray length{"coaptation_length_mm", true, 1, {}};
  uint32_t k = 0;
  for (const uint32_t end : coaptation.line_end) {
    for (const uint32_t begin = k; k < end; ++k) {
      block.points.push_back(coaptation.line[k].point);
      length.values.push_back(1e3 * coaptation.line[k].length);
      if (k > begin) block.lines.push_back({k - 1, k});
    }
  }
  block.arrays.push_back(std::move(length));
  block.numbers = {{"coaptation_area_mm2", 1e6 * coaptation.area},
                   {"coaptation_length_mean_mm", 1e3 * coaptation.length_mean}};
  return block;
}

// The blocks that the index of a former valve names and a new one does not have; none without it.
std::vector<std::string> blocks_of_old(const std::string &index_path, const std::string &name,
                                       const std::vector<VtkBlock> &blocks) {
  constexpr size_t most_bytes = 1 << 20;
  std::vector<std::string> old;
  std::string index;
  try {
    index = read_whole_file(index_path, most_bytes);
  } catch (const Error &) {
    return old;
  }
  for (const char *block : {"orifice", "coaptation_line"}) {
    const std::string file = " file=\"" + xml_escaped(name + "/" + block + ".vtp") + "\"";
    const bool stays = std::any_of(blocks.begin(), blocks.end(),
                                   [&](const VtkBlock &one) { return one.name == block; });
    if (!stays && index.find(file) != std::string::npos) old.emplace_back(block);
  }
  return old;
}

// Writes the index last: it refers to files that are complete.
void save_vtm(const mvs_snapshot &s, const std::string &path) {
  const bool is_named = in_small_letters(path).ends_with(".vtm");
  const std::string stem = is_named ? path.substr(0, path.size() - 4) : path;
  const size_t slash = stem.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : stem.substr(0, slash + 1),
                    name = stem.substr(folder.size());
  MVS_MUST(!name.empty() && stem != path, MVS_E_ARGUMENT, "path",
           "a VTM file is named NAME.vtm, with its blocks in the folder NAME");
  std::vector<VtkBlock> blocks;
  if (!s.orifice().triangles.empty()) blocks.push_back(orifice_block(s));
  if (!s.coaptation().line.empty()) blocks.push_back(coaptation_block(s));
  const std::vector<NamedFile> files = write_vtm(name, *s.model, s.state, result_arrays(s), blocks);
  const std::vector<std::string> old = blocks_of_old(path, name, blocks);
  const bool is_new = make_folder(stem);
  try {
    write_whole_files(files, folder);
  } catch (...) {
    if (is_new) remove_empty_folder(stem);
    throw;
  }
  for (const std::string &block : old)
    std::remove(format("%s/%s.vtp", stem.c_str(), block.c_str()).c_str());
}

std::string written(const mvs_snapshot &s, uint32_t format_given) {
  MVS_MUST(format_given != MVS_FORMAT_VTM, MVS_E_UNSUPPORTED, "format",
           "a VTM dataset is several files: save it to a path, or take MVS_FORMAT_VTP");
  MVS_MUST(format_given != MVS_FORMAT_INP, MVS_E_UNSUPPORTED, "format",
           "Abaqus input is read, not written: save as .obj, .h5 or .feb");
  if (format_given == MVS_FORMAT_FEB) return write_feb(*s.model, s.state);
  if (format_given == MVS_FORMAT_VTP) return write_vtp(*s.model, s.state, result_arrays(s));
  if (format_given == MVS_FORMAT_H5) return write_session(s.value, result_arrays(s));
  return write_obj(*s.model, s.state);
}

}  // namespace

extern "C" {

mvs_result mvs_load_file(mvs_sim *sim, const char *path, uint32_t format_given) {
  return file_at_boundary(path ? path : "", [&] {
    const AtWork at_work(sim);
    const uint32_t how = format_of(path, format_given, read_endings);
    load_bytes(*sim, read_whole_file(path), how);
  });
}

mvs_result mvs_load_memory(mvs_sim *sim, const void *data, uint64_t size, uint32_t format_given) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    load_bytes(s, read_bytes(data, size), checked_format(format_given));
  });
}

mvs_result mvs_save_file(const mvs_snapshot *snapshot, const char *path, uint32_t format_given) {
  return file_at_boundary(path ? path : "", [&] {
    must_point(snapshot, "snapshot");
    const uint32_t how = format_of(path, format_given, written_endings);
    if (how == MVS_FORMAT_VTM) return save_vtm(*snapshot, path);
    write_whole_file(path, written(*snapshot, how));
  });
}

mvs_result mvs_save_memory(const mvs_snapshot *snapshot, uint32_t format_given, void *data,
                           uint64_t capacity, uint64_t *size) {
  return at_boundary([&] {
    must_point(snapshot, "snapshot");
    write_bytes(data, capacity, size,
                [&] { return written(*snapshot, checked_format(format_given)); });
  });
}

}  // extern "C"
