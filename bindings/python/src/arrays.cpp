#include "arrays.h"

namespace mvs_python {
namespace {

using namespace py::literals;

py::dtype dtype_of(uint32_t type) {
  switch (type) {
    case MVS_TYPE_F64:
      return py::dtype::of<double>();
    case MVS_TYPE_F32:
      return py::dtype::of<float>();
    case MVS_TYPE_U32:
      return py::dtype::of<uint32_t>();
    case MVS_TYPE_U64:
      return py::dtype::of<uint64_t>();
    case MVS_TYPE_U8:
      return py::dtype::of<uint8_t>();
    default:
      refuse(MVS_E_INTERNAL, "", "the library shows an array of an unknown type");
  }
}

// The MVS_TYPE_* of the array's dtype, or 0 if it is not among `types`.
uint32_t type_among(const py::array &array, const std::vector<uint32_t> &types) {
  for (const uint32_t type : types) {
    if (array.dtype().equal(dtype_of(type))) return type;
  }
  return 0;
}

std::string expectation(const Wanted &wanted) {
  std::string text = "a NumPy array of ";
  for (size_t i = 0; i < wanted.types.size(); ++i) {
    text += (i ? " or " : "") + std::string(py::str(dtype_of(wanted.types[i])));
  }
  const std::string columns = wanted.components > 1 ? std::to_string(wanted.components) : "";
  return text + " and shape (count," + (columns.empty() ? "" : " " + columns) + ")";
}

bool rows_are_packed(const py::array &array) {
  const bool forward = array.strides(0) > 0;  // a broadcast row has stride 0
  const bool packed =
      array.ndim() == 1 || array.shape(1) == 1 || array.strides(1) == array.itemsize();
  const bool aligned = py::bool_(array.attr("flags").attr("aligned"));
  return forward && packed && aligned;
}

}  // namespace

py::array array_of(const mvs_view &view, const py::object &owner) {
  const py::dtype dtype = dtype_of(view.type);
  const auto stride = static_cast<py::ssize_t>(view.stride);
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(view.count)};
  std::vector<py::ssize_t> strides{stride ? stride : dtype.itemsize() * view.components};
  if (view.components > 1) {
    shape.push_back(view.components);
    strides.push_back(dtype.itemsize());
  }
  py::array array(dtype, shape, strides, view.data, owner);
  array.attr("setflags")("write"_a = false);
  return array;
}

py::array array_argument(const py::handle &value, const Wanted &wanted) {
  const std::string name = wanted.name;
  if (!py::isinstance<py::array>(value)) {
    refuse(MVS_E_ARGUMENT, name,
           name + ": " + expectation(wanted) + " is needed, not " +
               std::string(py::str(py::type::handle_of(value).attr("__name__"))));
  }
  if (py::hasattr(value, "mask")) {
    refuse(MVS_E_ARGUMENT, name,
           name +
               ": a masked array is given, whose masked values would be used: fill it, or leave "
               "them out");
  }
  const auto array = py::reinterpret_borrow<py::array>(value);
  const bool shaped = wanted.components == 1
                          ? array.ndim() == 1
                          : array.ndim() == 2 && array.shape(1) == wanted.components;
  if (!type_among(array, wanted.types) || !shaped) {
    refuse(MVS_E_ARGUMENT, name,
           name + ": " + expectation(wanted) + " is needed, not " +
               std::string(py::str(array.dtype())) + " of shape " +
               std::string(py::str(array.attr("shape"))) + "; nothing is converted silently");
  }
  return array;
}

mvs_array described(const py::array &array, std::vector<py::array> &kept) {
  kept.push_back(rows_are_packed(array) ? array : py::array(array.attr("copy")("order"_a = "C")));
  const py::array &used = kept.back();
  mvs_array description{};
  description.data = used.data();
  description.count = static_cast<uint64_t>(used.shape(0));
  description.components = used.ndim() > 1 ? static_cast<uint32_t>(used.shape(1)) : 1;
  description.type =
      type_among(used, {MVS_TYPE_F64, MVS_TYPE_F32, MVS_TYPE_U32, MVS_TYPE_U64, MVS_TYPE_U8});
  description.stride = static_cast<uint64_t>(used.strides(0));
  return description;
}

}  // namespace mvs_python
