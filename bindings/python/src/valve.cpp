#include "valve.h"

#include <pybind11/stl.h>

#include <algorithm>

namespace mvs_python {
namespace {

template <typename T>
constexpr const char *words_of = "a whole number from 0 on is";
template <>
constexpr const char *words_of<double> = "a number is";
template <>
constexpr const char *words_of<bool> = "True or False is";
template <>
constexpr const char *words_of<std::string> = "a text is";
template <>
constexpr const char *words_of<std::vector<double>> = "numbers are";
template <>
constexpr const char *words_of<std::vector<std::string>> = "texts are";
template <>
constexpr const char *words_of<std::vector<py::object>> = "a list is";

// A field of the valve, or of a part in one of its lists: ArgumentError that names it if it has
// another type.
template <typename T>
T field(const py::object &from, const char *name, const char *list = nullptr) {
  const py::object value = from.attr(name);
  try {
    return value.cast<T>();
  } catch (const py::cast_error &) {
    refuse(MVS_E_ARGUMENT, list ? list : name,
           std::string(list ? list : "") + (list ? ": " : "") + name + ": " + words_of<T> +
               " needed, not " + std::string(py::str(py::type::of(value).attr("__name__"))));
  }
}

// An optional array with `components` numbers per row of `of`; zeros if it is not given.
template <typename T>
std::vector<T> column(const py::object &valve, const char *name, uint32_t type, const char *of,
                      size_t rows, uint32_t components = 1) {
  std::vector<T> values = values_of<T>(valve.attr(name), {name, components, {type}});
  if (values.empty()) values.resize(components * rows);
  if (values.size() != components * rows) {
    refuse(MVS_E_ARGUMENT, name,
           std::string(name) + ": " + std::to_string(rows) + " rows are needed, one for each of " +
               of + ", not " + std::to_string(values.size() / components));
  }
  return values;
}

// The names and ids of the parts in a list of dataclasses; calls `read` with each part.
template <typename Desc, typename Read>
void read_parts(const py::object &valve, const char *list, std::vector<std::string> &names,
                std::vector<Desc> &descs, Read &&read) {
  const auto given = field<std::vector<py::object>>(valve, list);
  names.reserve(given.size());
  for (const py::object &part : given) {
    names.push_back(field<std::string>(part, "name", list));
    Desc desc{};
    desc.name = c_text(names.back(), list);
    desc.id = field<mvs_id>(part, "id", list);
    read(part, desc);
    descs.push_back(desc);
  }
}

}  // namespace

ValveArguments::ValveArguments(const py::object &valve) : valve_(valve) {
  py::module_::import("mvs.arrays").attr("check_types")(valve);
  read();
}

void ValveArguments::read() {
  desc_.struct_size = sizeof desc_;
  name_ = text_of(py::str(valve_.attr("name")), "name");
  desc_.name = c_text(name_, "name");
  if (field<bool>(valve_, "orient")) desc_.flags |= MVS_VALVE_FLAG_ORIENT;
  read_arrays();
  read_leaflets();
  read_scallops();
  read_chords();
  read_heads();
  read_rings();
  read_curves();
  read_numbers();
}

mvs_array ValveArguments::array(const char *name, uint32_t components,
                                std::vector<uint32_t> types) {
  const py::object value = valve_.attr(name);
  if (value.is_none()) return {};
  return described(array_argument(value, {name, components, std::move(types)}), kept_);
}

void ValveArguments::read_arrays() {
  desc_.nodes = array("nodes", 3, {MVS_TYPE_F64, MVS_TYPE_F32});
  desc_.nodes_loaded = array("nodes_loaded", 3, {MVS_TYPE_F64, MVS_TYPE_F32});
  desc_.nodes_now = array("nodes_now", 3, {MVS_TYPE_F64, MVS_TYPE_F32});
  desc_.nodes_open = array("nodes_open", 3, {MVS_TYPE_F64, MVS_TYPE_F32});
  desc_.node_origin = array("node_origin", 1, {MVS_TYPE_U32});
  desc_.triangles = array("triangles", 3, {MVS_TYPE_U32});
  desc_.triangle_leaflet = array("triangle_leaflet", 1, {MVS_TYPE_U32});
  desc_.triangle_scallop = array("triangle_scallop", 1, {MVS_TYPE_U32});
  desc_.triangle_thickness = array("triangle_thickness", 1, {MVS_TYPE_F64});
  desc_.triangle_fibre = array("triangle_fibre", 3, {MVS_TYPE_F64});
  desc_.annulus = array("annulus", 1, {MVS_TYPE_U32});
  if (!desc_.triangle_leaflet.data) {
    first_leaflet_.assign(desc_.triangles.count, 0);
    desc_.triangle_leaflet = {first_leaflet_.data(), first_leaflet_.size(), 1, MVS_TYPE_U32, 0};
  }
}

void ValveArguments::read_leaflets() {
  const py::module_ values = py::module_::import("mvs.arrays");
  const auto given = field<std::vector<py::object>>(valve_, "leaflets");
  leaflet_names_.reserve(given.size());
  for (py::object leaflet : given) {
    if (py::isinstance<py::str>(leaflet)) leaflet = values.attr("Leaflet")(leaflet);
    leaflet_names_.push_back(field<std::string>(leaflet, "name", "leaflets"));
    mvs_leaflet_desc desc{};
    desc.name = c_text(leaflet_names_.back(), "leaflets");
    desc.id = field<mvs_id>(leaflet, "id", "leaflets");
    desc.law = field<uint32_t>(leaflet, "law", "leaflets");
    desc.thickness = field<double>(leaflet, "thickness", "leaflets");
    const auto constants = field<std::vector<double>>(leaflet, "constants", "leaflets");
    if (constants.size() > std::size(desc.constants)) {
      refuse(MVS_E_ARGUMENT, "leaflets", "leaflets: a law has at most 8 constants");
    }
    std::copy(constants.begin(), constants.end(), desc.constants);
    leaflets_.push_back(desc);
  }
  desc_.leaflets = leaflets_.data();
  desc_.leaflet_stride = sizeof(mvs_leaflet_desc);
  desc_.leaflet_count = static_cast<uint32_t>(leaflets_.size());
}

void ValveArguments::read_scallops() {
  if (valve_.attr("scallops").is_none()) return;
  scallop_names_ = field<std::vector<std::string>>(valve_, "scallops");
  for (const std::string &name : scallop_names_) scallops_.push_back(c_text(name, "scallops"));
  scallop_ids_ =
      column<mvs_id>(valve_, "scallop_id", MVS_TYPE_U64, "scallops", scallop_names_.size());
  desc_.scallops = scallops_.data();
  desc_.scallop_ids = scallop_ids_.data();
  desc_.scallop_count = static_cast<uint32_t>(scallops_.size());
}

void ValveArguments::read_chords() {
  const py::object nodes = valve_.attr("chord_nodes");
  if (nodes.is_none()) return;
  const auto node = values_of<uint32_t>(nodes, {"chord_nodes", 2, {MVS_TYPE_U32}});
  const size_t count = node.size() / 2;
  const char *of = "chord_nodes";
  const auto length = column<double>(valve_, "chord_rest_length", MVS_TYPE_F64, of, count);
  const auto kind = column<uint32_t>(valve_, "chord_kind", MVS_TYPE_U32, of, count);
  const auto young = column<double>(valve_, "chord_young", MVS_TYPE_F64, of, count);
  const auto area = column<double>(valve_, "chord_area", MVS_TYPE_F64, of, count);
  const auto id = column<mvs_id>(valve_, "chord_id", MVS_TYPE_U64, of, count);
  const auto law = column<uint32_t>(valve_, "chord_law", MVS_TYPE_U32, of, count);
  const auto constants = column<double>(valve_, "chord_constants", MVS_TYPE_F64, of, count, 6);
  chord_names_ = names("chord_names", count);
  for (size_t c = 0; c < count; ++c) {
    mvs_chord_desc chord{};
    chord.node_a = node[2 * c];
    chord.node_b = node[2 * c + 1];
    chord.kind = kind[c];
    chord.rest_length = length[c];
    chord.young = young[c];
    chord.area = area[c];
    chord.id = id[c];
    chord.law = law[c];
    std::copy_n(&constants[6 * c], 6, chord.constants);
    if (!chord_names_.empty()) chord.name = c_text(chord_names_[c], "chord_names");
    chords_.push_back(chord);
  }
  desc_.chords = chords_.data();
  desc_.chord_stride = sizeof(mvs_chord_desc);
  desc_.chord_count = static_cast<uint32_t>(count);
}

void ValveArguments::read_heads() {
  const auto nodes =
      values_of<uint32_t>(valve_.attr("head_nodes"), {"head_nodes", 1, {MVS_TYPE_U32}});
  const auto id = column<mvs_id>(valve_, "head_id", MVS_TYPE_U64, "head_nodes", nodes.size());
  head_names_ = names("head_names", nodes.size());
  for (size_t h = 0; h < nodes.size(); ++h) {
    mvs_head_desc head{};
    head.node = nodes[h];
    head.id = id[h];
    if (!head_names_.empty()) head.name = c_text(head_names_[h], "head_names");
    heads_.push_back(head);
  }
  desc_.heads = heads_.data();
  desc_.head_stride = sizeof(mvs_head_desc);
  desc_.head_count = static_cast<uint32_t>(heads_.size());
}

void ValveArguments::read_rings() {
  read_parts(valve_, "rings", ring_names_, rings_, [&](const py::object &ring, auto &desc) {
    desc.kind = field<uint32_t>(ring, "kind", "rings");
    const Wanted wanted{"rings", 3, {MVS_TYPE_F64, MVS_TYPE_F32}};
    desc.curve = described(array_argument(ring.attr("curve"), wanted), kept_);
  });
  desc_.rings = rings_.data();
  desc_.ring_stride = sizeof(mvs_ring_desc);
  desc_.ring_count = static_cast<uint32_t>(rings_.size());
}

void ValveArguments::read_curves() {
  read_parts(valve_, "curves", curve_names_, curves_, [&](const py::object &curve, auto &desc) {
    const Wanted wanted{"curves", 2, {MVS_TYPE_F64, MVS_TYPE_F32}};
    desc.points = described(array_argument(curve.attr("points"), wanted), kept_);
  });
  desc_.curves = curves_.data();
  desc_.curve_stride = sizeof(mvs_curve_desc);
  desc_.curve_count = static_cast<uint32_t>(curves_.size());
}

void ValveArguments::read_numbers() {
  desc_.density = positive("density");
  desc_.contact_thickness = positive("contact_thickness");
  desc_.contact_stiffness = positive("contact_stiffness");
  desc_.bending_scale = number("bending_scale");
  // 0 means the default in the C struct and "no bending" in Python, where None is the default
  if (desc_.bending_scale == 0 && !valve_.attr("bending_scale").is_none()) {
    desc_.flags |= MVS_VALVE_FLAG_NO_BENDING;
  }
}

double ValveArguments::number(const char *name) const {
  return valve_.attr(name).is_none() ? 0 : field<double>(valve_, name);
}

double ValveArguments::positive(const char *name) const {
  const bool given = !valve_.attr(name).is_none();
  return given_or_default(given ? std::optional(number(name)) : std::nullopt, name);
}

std::vector<std::string> ValveArguments::names(const char *name, size_t count) const {
  const py::object value = valve_.attr(name);
  if (value.is_none()) return {};
  auto given = field<std::vector<std::string>>(valve_, name);
  if (given.size() != count) {
    refuse(MVS_E_ARGUMENT, name,
           std::string(name) + ": " + std::to_string(count) + " names are needed, not " +
               std::to_string(given.size()));
  }
  return given;
}

}  // namespace mvs_python
