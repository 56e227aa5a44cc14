// Arrays of the surface by name; landmarks from their files, else from the findings of an earlier
// import.
#include "import/import_input.h"

#include <cstdint>

#include "import/findings_file.h"
#include "text/console.h"
#include "valve/tissue.h"

namespace cli {
namespace {

mvs_surface_kind kind_number(const std::string &kind) {
  if (kind == "mid") return MVS_SURFACE_KIND_MID;
  if (kind == "atrial") return MVS_SURFACE_KIND_ATRIAL;
  return kind == "skin" ? MVS_SURFACE_KIND_SKIN : 0;
}

// The values of a named array of the surface, one a row.
std::vector<double> array_values(const mvs::SurfaceFile &file, const std::string &name,
                                 mvs_surface_place place) {
  std::string known;
  for (const mvs_surface_array &array : file.arrays()) {
    if (array.place == place && name == array.name && array.values.components == 1) {
      const mvs::View<double> view(array.values);
      return {view.begin(), view.end()};
    }
    known += std::string(known.empty() ? "" : ", ") + array.name;
  }
  fail(MVS_E_ID, name,
       "the surface has no array \"" + name + "\" with one value for each " +
           (place == MVS_SURFACE_PLACE_POINT ? "point" : "triangle") +
           (known.empty() ? "; it has no arrays" : "; it has: " + known));
}

std::vector<uint32_t> labels_of(const mvs::SurfaceFile &file, const std::string &name) {
  std::vector<uint32_t> labels;
  for (const double value : array_values(file, name, MVS_SURFACE_PLACE_TRIANGLE)) {
    if (value != 0 && value != 1 && value != 2) {
      fail(MVS_E_FORMAT, name,
           text("the array \"%s\" has the value %g: 0 is unknown, 1 anterior, 2 posterior",
                name.c_str(), value));
    }
    labels.push_back(static_cast<uint32_t>(value));
  }
  return labels;
}

// Guesses that an option replaces.
void forget_given(const ImportOptions &options, KnownValues &known) {
  const std::pair<const char *, bool> given[] = {
      {"annulus", !options.annulus.empty()},
      {"commissures", !options.commissures.empty()},
      {"anterior", !options.anterior.empty()},
      {"papillary_tips", !options.tips.empty()},
      {"closed_annulus", !options.closed_annulus.empty()},
      {"closed_tips", !options.closed_tips.empty()},
      {"thickness", options.thickness != 0},
      {"edge_error", options.edge_error != 0},
      {"edge_lost", options.edge_lost != 0},
      {"thickness_error", options.thickness_error != 0},
      {"closed_error", options.closed_error != 0},
      {"tissue", !options.leaflet.empty()}};
  for (const auto &[name, is_given] : given) {
    if (is_given) known.unsure.erase(name);
  }
}

// The lengths that are known, where no option gives them.
void take_known_lengths(const ImportOptions &options, const KnownValues &known,
                        mvs_build_options &build) {
  const auto take = [](double option, const std::vector<double> &value, double &to) {
    if (option == 0 && !value.empty()) to = value[0];
  };
  take(options.thickness, known.thickness, build.thickness);
  take(options.edge_error, known.edge_error, build.edge_error);
  take(options.edge_lost, known.edge_lost, build.edge_lost);
  take(options.thickness_error, known.thickness_error, build.thickness_error);
  take(options.closed_error, known.closed_error, build.closed_error);
}

mvs_array array_of(const mvs_view &view) {
  return {view.data, view.count, view.components, view.type, view.stride};
}

mvs_array points_of(const std::vector<double> &values) {
  if (values.empty()) return {};
  return {values.data(), values.size() / 3, 3, MVS_TYPE_F64, 0};
}

}  // namespace

ImportInput read_input(const ImportOptions &options, ImportOptions &with_known,
                       KnownValues &known) {
  if (!options.with.empty()) known = read_findings(options.with);
  forget_given(options, known);
  ImportInput input{
      PatientFiles(options.files, options.surface), {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
  PatientFiles &files = input.files;
  for (const std::string *path : {&options.annulus, &options.commissures, &options.anterior,
                                  &options.tips, &options.closed_annulus, &options.closed_tips}) {
    files.add_landmarks(*path);
  }
  files.add_surface(options.closed);
  files.settle_frames();
  const auto landmarks = [&](const std::string &path, const std::vector<double> &else_known) {
    return path.empty() ? else_known : files.points(path);
  };
  input.points = files.points(options.surface);
  input.annulus = landmarks(options.annulus, known.annulus);
  input.commissures = landmarks(options.commissures, known.commissures);
  input.anterior = landmarks(options.anterior, known.anterior);
  input.tips = landmarks(options.tips, known.papillary_tips);
  input.closed = files.points(options.closed);
  input.closed_annulus = landmarks(options.closed_annulus, known.closed_annulus);
  input.closed_tips = landmarks(options.closed_tips, known.closed_tips);
  const mvs::SurfaceFile &surface = files.file(options.surface);
  if (!options.label_array.empty()) input.labels = labels_of(surface, options.label_array);
  if (!options.thickness_array.empty()) {
    const double metre = metres(surface.info().unit);
    input.thickness = array_values(surface, options.thickness_array, MVS_SURFACE_PLACE_POINT);
    for (double &value : input.thickness) value *= metre;
  }
  take_known_lengths(options, known, with_known.build);
  if (options.leaflet.empty() && !known.tissue.empty()) {
    with_known.build.leaflet_law = law_of_finding(known.tissue[0], options.with);
  }
  return input;
}

mvs_surface_desc desc_of(const ImportInput &input, const ImportOptions &options,
                         const std::string &name) {
  mvs_surface_desc desc = {};
  desc.kind = kind_number(options.kind);
  desc.name = name.c_str();
  desc.points = points_of(input.points);
  desc.triangles = array_of(input.files.file(options.surface).info().triangles);
  if (!input.labels.empty()) {
    desc.triangle_leaflet = {input.labels.data(), input.labels.size(), 1, MVS_TYPE_U32, 0};
  }
  if (!input.thickness.empty()) {
    desc.point_thickness = {input.thickness.data(), input.thickness.size(), 1, MVS_TYPE_F64, 0};
  }
  desc.annulus = points_of(input.annulus);
  desc.commissures = points_of(input.commissures);
  desc.anterior = points_of(input.anterior);
  desc.papillary_tips = points_of(input.tips);
  desc.closed_annulus = points_of(input.closed_annulus);
  desc.closed_tips = points_of(input.closed_tips);
  if (!options.closed.empty()) {
    desc.closed_points = points_of(input.closed);
    desc.closed_triangles = array_of(input.files.file(options.closed).info().triangles);
  }
  return desc;
}

}  // namespace cli
