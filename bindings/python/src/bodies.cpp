// Reads the keys of each body; the library checks their values.
#include "bodies.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "errors.h"

namespace mvs_python {
namespace {

using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;

uint32_t body_kind_of(const std::string &name) {
  const char *const names[] = {"hull", "ball", "capsule", "box", "cylinder", "cone"};
  for (uint32_t k = 0; k < std::size(names); ++k) {
    if (name == names[k]) return MVS_BODY_KIND_HULL + k;
  }
  refuse(MVS_E_ARGUMENT, "bodies",
         "bodies: kind \"hull\", \"ball\", \"capsule\", \"box\", \"cylinder\" or \"cone\" is "
         "needed, not \"" +
             name + "\"");
}

template <size_t Size>
void copy_numbers(const py::handle &from, double (&to)[Size]) {
  const auto numbers = py::cast<std::array<double, Size>>(from);
  std::copy(numbers.begin(), numbers.end(), to);
}

}  // namespace

Bodies::Bodies(const std::vector<py::dict> &given) {
  for (const py::dict &body : given) {
    mvs_body_desc desc{};
    for (const auto &[key, value] : body) set(desc, py::cast<std::string>(key), value);
    descs.push_back(desc);
  }
}

void Bodies::set(mvs_body_desc &desc, const std::string &key, const py::handle &value) {
  if (key == "kind") {
    desc.kind = body_kind_of(py::cast<std::string>(value));
  } else if (key == "position") {
    copy_numbers(value, desc.position);
  } else if (key == "end") {
    copy_numbers(value, desc.end);
  } else if (key == "size" && py::isinstance<py::float_>(value)) {
    desc.size[0] = py::cast<double>(value);
  } else if (key == "size") {
    copy_numbers(value, desc.size);
  } else if (key == "orientation") {
    copy_numbers(value, desc.orientation);
  } else if (key == "radius") {
    desc.radius = py::cast<double>(value);
  } else if (key == "vertices") {
    const auto &points = vertices.emplace_back(py::cast<Points>(value));
    const bool is_table = points.ndim() == 2 && points.shape(1) == 3;
    if (!is_table) refuse(MVS_E_ARGUMENT, "bodies", "bodies: vertices have to be n x 3 numbers");
    desc.vertices = {points.data(), static_cast<uint64_t>(points.shape(0)), 3, MVS_TYPE_F64, 0};
  } else {
    refuse(MVS_E_ARGUMENT, "bodies", "bodies: a body has no \"" + key + "\"");
  }
}

}  // namespace mvs_python
