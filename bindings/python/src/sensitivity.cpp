#include "sensitivity.h"

#include <mvs/sensitivity.h>
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>

#include "arrays.h"
#include "progress.h"

namespace mvs_python {
namespace {

using namespace py::literals;

// Names and arrays that the C structs point to.
struct Kept {
  std::vector<std::string> names;
  std::vector<py::array> arrays;
};

mvs_array array_or_none(const py::handle &value, const char *name, Kept &kept) {
  if (value.is_none()) return {};
  const Wanted wanted{name, 3, {MVS_TYPE_F64, MVS_TYPE_F32}};
  return described(array_argument(value, wanted), kept.arrays);
}

// From tuples (kind, index, component, measure, point, weights).
std::vector<mvs_quantity> quantities_of(const py::list &rows, Kept &kept) {
  kept.names.reserve(rows.size());
  std::vector<mvs_quantity> list;
  for (const py::handle &item : rows) {
    const auto row = item.cast<py::tuple>();
    mvs_quantity q = {};
    q.kind = row[0].cast<uint32_t>();
    q.index = row[1].cast<uint32_t>();
    q.component = row[2].cast<uint32_t>();
    if (!row[3].is_none()) {
      kept.names.push_back(row[3].cast<std::string>());
      q.measure = kept.names.back().c_str();
    }
    if (!row[4].is_none()) {
      const auto point = row[4].cast<std::array<double, 3>>();
      std::copy(point.begin(), point.end(), q.point);
    }
    q.weights = array_or_none(row[5], "weights", kept);
    list.push_back(q);
  }
  return list;
}

// From tuples (kind, index, component, mode).
std::vector<mvs_parameter> parameters_of(const py::list &rows, Kept &kept) {
  std::vector<mvs_parameter> list;
  for (const py::handle &item : rows) {
    const auto row = item.cast<py::tuple>();
    mvs_parameter p = {};
    p.kind = row[0].cast<uint32_t>();
    p.index = row[1].cast<uint32_t>();
    p.component = row[2].cast<uint32_t>();
    p.mode = array_or_none(row[3], "mode", kept);
    list.push_back(p);
  }
  return list;
}

py::dict arrays_of(const std::shared_ptr<mvs_sensitivity> &found) {
  static constexpr std::pair<const char *, mvs_sensitivity_array> names[] = {
      {"value", MVS_SENSITIVITY_ARRAY_VALUE},
      {"derivative", MVS_SENSITIVITY_ARRAY_DERIVATIVE},
      {"above", MVS_SENSITIVITY_ARRAY_ABOVE},
      {"below", MVS_SENSITIVITY_ARRAY_BELOW},
      {"of_notes", MVS_SENSITIVITY_ARRAY_QUANTITY_NOTES},
      {"to_notes", MVS_SENSITIVITY_ARRAY_PARAMETER_NOTES},
      {"weak_chords", MVS_SENSITIVITY_ARRAY_WEAK_CHORDS},
      {"weak_contacts", MVS_SENSITIVITY_ARRAY_WEAK_CONTACTS},
      {"motion", MVS_SENSITIVITY_ARRAY_MOTION}};
  const py::capsule owner(new std::shared_ptr<mvs_sensitivity>(found), [](void *held) {
    delete static_cast<std::shared_ptr<mvs_sensitivity> *>(held);
  });
  py::dict arrays;
  for (const auto &[name, which] : names) {
    mvs_view view{};
    must(mvs_sensitivity_get_array(found.get(), which, &view));
    arrays[name] = array_of(view, owner);
  }
  return arrays;
}

py::dict sensitivity(const Snapshot &self, const py::list &of, const py::list &to, uint32_t flags,
                     std::optional<double> slack, py::object progress) {
  Kept kept;
  const std::vector<mvs_quantity> quantities = quantities_of(of, kept);
  const std::vector<mvs_parameter> parameters = parameters_of(to, kept);
  auto options = sized<mvs_sensitivity_options>();
  options.flags = flags;
  options.slack = given_or_default(slack, "slack");
  ProgressCall call(std::move(progress));
  options.progress = &ProgressCall::callback;
  options.user = &call;
  mvs_sensitivity *made = nullptr;
  call.run([&] {
    return mvs_sensitivity_run(self.get(), quantities.data(),
                               static_cast<uint32_t>(quantities.size()), sizeof(mvs_quantity),
                               parameters.data(), static_cast<uint32_t>(parameters.size()),
                               sizeof(mvs_parameter), &options, &made);
  });
  const std::shared_ptr<mvs_sensitivity> found(made, &mvs_sensitivity_release);
  auto summary = sized<mvs_sensitivity_summary>();
  must(mvs_sensitivity_get_summary(found.get(), &summary));
  py::dict result = arrays_of(found);
  result["smooth"] = summary.smooth != 0;
  result["adjoint_solves"] = summary.adjoint_solves;
  result["direct_solves"] = summary.direct_solves;
  result["residual"] = summary.residual;
  result["linear_error"] = summary.linear_error;
  result["stiffness_margin"] = summary.stiffness_margin;
  return result;
}

}  // namespace

void bind_sensitivity(py::class_<Snapshot> &type) {
  type.def("_sensitivity", &sensitivity, "of"_a, "to"_a, "flags"_a, "slack"_a,
           "progress"_a = py::none());
}

}  // namespace mvs_python
