#include "operations.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <pybind11/stl.h>

namespace mvs_python {
namespace {

using Triple = std::array<double, 3>;

py::dict field_of(uint32_t kind, uint32_t index) {
  auto info = sized<mvs_field_info>();
  must(mvs_get_op_field(kind, index, &info));
  py::dict field;
  field["name"] = info.name;
  field["type"] = info.type;
  field["offset"] = info.offset;
  field["required"] = info.required != 0;
  field["low"] = info.low;
  field["high"] = info.high;
  field["unit"] = info.unit;
  field["help"] = info.help;
  field["choices"] = info.choices;
  // a number, the word of a choice, or a rule ("of the valve"); None: the field has no default
  const bool is_number = info.type != MVS_FIELD_CHOICE && !std::isnan(info.default_value);
  field["default"] = is_number            ? py::object(py::float_(info.default_value))
                     : *info.default_text ? py::object(py::str(info.default_text))
                                          : py::object(py::none());
  return field;
}

}  // namespace

OpStruct::OpStruct(const py::object &operation, const py::object &snapshot) {
  const py::object kind = operation.attr("kind");
  const auto size = kind.attr("size").cast<uint32_t>();
  words_.assign((size + 7) / 8, 0);
  at<mvs_op>(0) = {size, kind.attr("number").cast<uint32_t>()};
  for (const py::handle row : operation.attr("rows")(snapshot)) {
    const auto [type, offset, value] = row.cast<std::tuple<uint32_t, uint32_t, py::object>>();
    write(type, offset, value);
  }
}

// mvs.ops has converted `value` to the type of the field.
void OpStruct::write(uint32_t type, uint32_t offset, const py::object &value) {
  switch (type) {
    case MVS_FIELD_NUMBER:
      at<double>(offset) = value.cast<double>();
      return;
    case MVS_FIELD_COUNT:
    case MVS_FIELD_CHOICE:
      at<uint32_t>(offset) = value.cast<uint32_t>();
      return;
    case MVS_FIELD_CHORD:
    case MVS_FIELD_HEAD:
    case MVS_FIELD_SCALLOP:
      at<mvs_id>(offset) = value.cast<mvs_id>();
      return;
    case MVS_FIELD_SITE: {
      const auto [how, index, scallop, u] =
          value.cast<std::tuple<uint32_t, uint32_t, mvs_id, Triple>>();
      at<mvs_site>(offset) = {how, index, scallop, {u[0], u[1], u[2]}};
      return;
    }
    case MVS_FIELD_POINT: {
      const auto p = value.cast<Triple>();
      at<mvs_point>(offset) = {{p[0], p[1], p[2]}, 1, 0};
      return;
    }
    case MVS_FIELD_VECTOR: {
      const auto v = value.cast<Triple>();
      std::copy(v.begin(), v.end(), &at<double>(offset));
      return;
    }
    case MVS_FIELD_POINTS:
      at<mvs_array>(offset) =
          described(array_argument(value, {"points", 3, {MVS_TYPE_F64}}), kept_);
      return;
    case MVS_FIELD_TEXT:
      texts_.push_back(text_of(value, "text"));
      at<const char *>(offset) = texts_.back().c_str();
      return;
    default:
      refuse(MVS_E_VERSION, "", "the library has a type of field that this module does not know");
  }
}

py::list op_kinds() {
  py::list kinds;
  for (uint32_t k = 0; k < mvs_get_op_count(); ++k) {
    auto info = sized<mvs_op_info>();
    must(mvs_get_op_info(k, &info));
    py::list fields;
    for (uint32_t f = 0; f < info.fields; ++f) fields.append(field_of(k, f));
    py::dict kind;
    kind["name"] = info.name;
    kind["number"] = info.kind;
    kind["size"] = info.size;
    kind["help"] = info.help;
    kind["fields"] = fields;
    kinds.append(kind);
  }
  return kinds;
}

}  // namespace mvs_python
