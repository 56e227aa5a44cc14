// Bodies of a convex tool, from dictionaries.
#pragma once

#include <mvs/tool.h>
#include <pybind11/numpy.h>

#include <string>
#include <vector>

namespace mvs_python {

namespace py = pybind11;

// Bodies with the vertices that they point to.
struct Bodies {
  // Throws ArgumentError for an unknown kind or key, and for vertices that are not n x 3 numbers.
  explicit Bodies(const std::vector<py::dict> &given);

  std::vector<mvs_body_desc> descs;
  std::vector<py::array_t<double, py::array::c_style | py::array::forcecast>> vertices;

 private:
  void set(mvs_body_desc &desc, const std::string &key, const py::handle &value);
};

}  // namespace mvs_python
