#include "operation.h"

#include <pybind11/stl.h>

#include <array>
#include <cstring>
#include <sstream>

namespace mvs_python {
namespace {

mvs_op_info info_at(uint32_t index) {
  mvs_op_info info{};
  info.struct_size = sizeof info;
  must(mvs_op_describe(index, &info));
  return info;
}

mvs_field_info field_at(uint32_t index, uint32_t field) {
  mvs_field_info info{};
  info.struct_size = sizeof info;
  must(mvs_op_describe_field(index, field, &info));
  return info;
}

std::vector<mvs_field_info> fields_of(uint32_t index) {
  std::vector<mvs_field_info> fields;
  for (uint32_t k = 0; k < info_at(index).fields; ++k) fields.push_back(field_at(index, k));
  return fields;
}

uint32_t index_of(const std::string &kind) {
  std::string known;
  for (uint32_t index = 0; index < mvs_op_count(); ++index) {
    if (kind == info_at(index).name) return index;
    known += (known.empty() ? "" : ", ") + std::string(info_at(index).name);
  }
  refuse(MVS_E_ARGUMENT, kind,
         "there is no operation \"" + kind + "\"; the operations are " + known);
}

const mvs_field_info &field_named(const std::vector<mvs_field_info> &fields,
                                  const std::string &kind, const std::string &name) {
  std::string known;
  for (const mvs_field_info &field : fields) {
    if (name == field.name) return field;
    known += (known.empty() ? "" : ", ") + std::string(field.name);
  }
  refuse(MVS_E_ARGUMENT, kind + "." + name,
         kind + ": there is no field \"" + name + "\"; its fields are " + known);
}

// "leaflet=1 head=2" as a dictionary.
py::dict choices_of(const mvs_field_info &field) {
  py::dict choices;
  std::istringstream words(field.choices);
  for (std::string word; words >> word;) {
    const size_t equals = word.find('=');
    choices[py::str(word.substr(0, equals))] = std::stoul(word.substr(equals + 1));
  }
  return choices;
}

const char *type_name(uint32_t type) {
  static constexpr const char *names[] = {"",        "number", "count", "choice", "chord",  "head",
                                          "scallop", "site",   "point", "vector", "points", "text"};
  return type < std::size(names) ? names[type] : "";
}

}  // namespace

OperationArguments::OperationArguments(const std::string &kind, const py::dict &fields,
                                       const Snapshot &valve)
    : kind_(kind), valve_(valve) {
  const uint32_t index = index_of(kind);
  const mvs_op_info info = info_at(index);
  bytes_.assign((info.size + 7) / 8, 0);
  const mvs_op head{info.size, info.kind};
  std::memcpy(bytes_.data(), &head, sizeof head);
  const std::vector<mvs_field_info> known = fields_of(index);
  for (const auto &[name, value] : fields) {
    const mvs_field_info &field = field_named(known, kind, py::str(name));
    if (!value.is_none()) set(field, value);
  }
}

std::string OperationArguments::label(const mvs_field_info &field) const {
  return kind_ + "." + field.name;
}

template <typename T>
void OperationArguments::put(const mvs_field_info &field, const T &value) {
  std::memcpy(reinterpret_cast<char *>(bytes_.data()) + field.offset, &value, sizeof value);
}

template <typename T>
T OperationArguments::cast(const mvs_field_info &field, const py::handle &value,
                           const char *expected) const {
  try {
    return value.cast<T>();
  } catch (const py::cast_error &) {
    refuse(MVS_E_ARGUMENT, label(field),
           label(field) + ": " + expected + " is needed, not " +
               std::string(py::str(py::type::handle_of(value).attr("__name__"))));
  }
}

void OperationArguments::set(const mvs_field_info &field, const py::handle &value) {
  switch (field.type) {
    case MVS_FIELD_NUMBER:
    case MVS_FIELD_COUNT:
      return set_number(field, value);
    case MVS_FIELD_CHOICE: {
      const py::dict choices = choices_of(field);
      const py::handle number = choices.contains(value) ? choices[value] : value;
      return put(field, cast<uint32_t>(field, number, field.choices));
    }
    case MVS_FIELD_CHORD:
      return put(field, id_of(field, MVS_PART_CHORD, value));
    case MVS_FIELD_HEAD:
      return put(field, id_of(field, MVS_PART_HEAD, value));
    case MVS_FIELD_SCALLOP:
      return put(field, id_of(field, MVS_PART_SCALLOP, value));
    case MVS_FIELD_SITE:
      return put(field, site_of(field, value));
    case MVS_FIELD_POINT:
    case MVS_FIELD_VECTOR: {
      mvs_point point{{}, 1, 0};
      const auto at = cast<std::array<double, 3>>(field, value, "a sequence of three numbers");
      std::copy(at.begin(), at.end(), point.at);
      return field.type == MVS_FIELD_POINT ? put(field, point) : put(field, point.at);
    }
    case MVS_FIELD_POINTS:
      return set_points(field, value);
    case MVS_FIELD_TEXT:
      texts_.push_back(cast<std::string>(field, value, "a text"));
      return put(field, texts_.back().c_str());
    default:
      refuse(MVS_E_INTERNAL, label(field), label(field) + ": a field of an unknown type");
  }
}

// In the C struct zero is "not given"; who writes zero in Python means zero.
void OperationArguments::set_number(const mvs_field_info &field, const py::handle &value) {
  const auto number = cast<double>(field, value, "a number");
  if (number == 0 && field.low > 0) {
    std::ostringstream sentence;
    sentence << kind_ << ": " << field.name << " is 0, it has to be " << field.low << " to "
             << field.high << (*field.unit ? " " : "") << field.unit;
    refuse(MVS_E_ARGUMENT, label(field), sentence.str());
  }
  if (field.type == MVS_FIELD_NUMBER) return put(field, number);
  put(field, cast<uint32_t>(field, value, "a whole number, not negative,"));
}

void OperationArguments::set_points(const mvs_field_info &field, const py::handle &value) {
  put(field, described(array_argument(value, {field.name, 3, {MVS_F64}}), arrays_));
}

mvs_id OperationArguments::id_of(const mvs_field_info &field, uint32_t part_kind,
                                 const py::handle &value) const {
  if (py::isinstance<py::str>(value)) {
    mvs_part part{};
    must(mvs_snapshot_find(valve_.get(), part_kind, value.cast<std::string>().c_str(), &part));
    return part.id;
  }
  const py::object id = py::getattr(value, "id", py::reinterpret_borrow<py::object>(value));
  return cast<mvs_id>(field, id, "a mvs.Part, its name or its id");
}

mvs_site OperationArguments::site_of(const mvs_field_info &field, const py::handle &value) const {
  static constexpr const char *expected =
      "a node, (triangle, (u, v, w)) or (scallop, along, height)";
  mvs_site site{};
  if (!py::isinstance<py::sequence>(value) || py::isinstance<py::str>(value)) {
    site.how = MVS_SITE_NODE;
    site.index = cast<uint32_t>(field, value, expected);
    return site;
  }
  const auto parts = cast<std::vector<py::object>>(field, value, expected);
  if (parts.size() == 2) {
    const auto weight = cast<std::array<double, 3>>(field, parts[1], expected);
    site.how = MVS_SITE_TRIANGLE;
    site.index = cast<uint32_t>(field, parts[0], expected);
    std::copy(weight.begin(), weight.end(), site.u);
  } else if (parts.size() == 3) {
    site.how = MVS_SITE_ANATOMICAL;
    site.scallop = id_of(field, MVS_PART_SCALLOP, parts[0]);
    site.u[0] = cast<double>(field, parts[1], expected);
    site.u[1] = cast<double>(field, parts[2], expected);
  } else {
    refuse(MVS_E_ARGUMENT, label(field), label(field) + ": " + expected + " is needed");
  }
  return site;
}

std::string op_name(uint32_t kind) {
  for (uint32_t index = 0; index < mvs_op_count(); ++index) {
    if (info_at(index).kind == kind) return info_at(index).name;
  }
  return std::to_string(kind);
}

py::tuple operations() {
  const py::module_ values = py::module_::import("mvs.values");
  py::list kinds;
  for (uint32_t index = 0; index < mvs_op_count(); ++index) {
    py::list fields;
    for (const mvs_field_info &f : fields_of(index)) {
      fields.append(values.attr("OperationField")(f.name, type_name(f.type), f.required != 0, f.low,
                                                  f.high, f.unit, f.help, choices_of(f)));
    }
    const mvs_op_info info = info_at(index);
    kinds.append(values.attr("OperationKind")(info.name, info.help, py::tuple(fields)));
  }
  return py::tuple(kinds);
}

py::object history_value(const Snapshot &snapshot) {
  const py::module_ values = py::module_::import("mvs.values");
  mvs_history found{};
  found.struct_size = sizeof found;
  must(mvs_snapshot_history(snapshot.get(), &found));
  py::list done, undone, checkpoints;
  for (uint32_t index = 0; index < found.done + found.undone; ++index) {
    mvs_history_entry entry{};
    entry.struct_size = sizeof entry;
    must(mvs_snapshot_history_entry(snapshot.get(), index, &entry));
    (index < found.done ? done : undone)
        .append(values.attr("HistoryEntry")(op_name(entry.kind), entry.title, entry.made,
                                            entry.group, entry.in_group));
  }
  for (uint32_t index = 0; index < found.checkpoints; ++index) {
    checkpoints.append(mvs_snapshot_checkpoint(snapshot.get(), index));
  }
  return values.attr("History")(py::tuple(done), py::tuple(undone), py::tuple(checkpoints));
}

}  // namespace mvs_python
