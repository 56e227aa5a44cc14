// NumPy arrays from views of a snapshot, and arrays for the C interface from NumPy arrays.
#pragma once

#include <mvs/base.h>
#include <pybind11/numpy.h>

#include <vector>

#include "errors.h"

namespace mvs_python {

// A read-only array on the memory of a view; `owner` is kept alive by it.
py::array array_of(const mvs_view &view, const py::object &owner);

// The dtypes an argument may have, and how many values its rows hold (1: one-dimensional).
struct Wanted {
  const char *name;
  uint32_t components;
  std::vector<uint32_t> types;  // MVS_TYPE_F64 ...
};

// The array an argument is, checked for dtype and shape; raises ArgumentError otherwise. Never
// converts: a silent cast of indices or lengths hides a fault of the caller.
py::array array_argument(const py::handle &value, const Wanted &wanted);

// The description of a checked array, read in place wherever its rows are packed; otherwise of a
// packed copy of the same values. What is described is kept alive in `kept`.
mvs_array described(const py::array &array, std::vector<py::array> &kept);

// A checked one-dimensional argument as a vector; None is empty.
template <typename T>
std::vector<T> values_of(const py::handle &value, const Wanted &wanted) {
  std::vector<T> values;
  if (value.is_none()) return values;
  const auto array = py::array_t<T>(array_argument(value, wanted));
  const auto row = array.template unchecked<1>();
  for (py::ssize_t i = 0; i < row.shape(0); ++i) values.push_back(row(i));
  return values;
}

}  // namespace mvs_python
