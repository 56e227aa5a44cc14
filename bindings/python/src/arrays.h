// NumPy arrays from views of a snapshot, and arrays for the C interface from NumPy arrays.
#pragma once

#include <mvs/base.h>
#include <pybind11/numpy.h>

#include <vector>

#include "errors.h"

namespace mvs_python {

// A read-only array over the memory of a view; it keeps `owner` alive.
py::array array_of(const mvs_view &view, const py::object &owner);

// The dtypes and the row length that an argument may have (1: one-dimensional).
struct Wanted {
  const char *name;
  uint32_t components;
  std::vector<uint32_t> types;  // MVS_TYPE_F64 ...
};

// Checks that an argument is an array of a wanted dtype and shape, and returns it; else raises
// ArgumentError. Never converts: a silent cast of indices or lengths would hide an error of the
// caller.
py::array array_argument(const py::handle &value, const Wanted &wanted);

// Describes a checked array for the C interface: the array if its rows are packed, else a packed
// copy. `kept` keeps the described array alive.
mvs_array described(const py::array &array, std::vector<py::array> &kept);

// The values of a checked argument, row by row; empty for None.
template <typename T>
std::vector<T> values_of(const py::handle &value, const Wanted &wanted) {
  if (value.is_none()) return {};
  const py::array_t<T, py::array::c_style> array(array_argument(value, wanted));
  return {array.data(), array.data() + array.size()};
}

}  // namespace mvs_python
