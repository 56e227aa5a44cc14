// Surgical operations from keyword arguments. Which there are and what fields they have is what
// mvs_op_describe tells: a new kind needs no line here.
#pragma once

#include <mvs/op.h>

#include <deque>
#include <string>
#include <vector>

#include "arrays.h"
#include "snapshot.h"

namespace mvs_python {

// Packs the struct of an operation, and holds all that it points to.
class OperationArguments {
 public:
  // Names of parts are looked up in `valve`. Raises ArgumentError for a kind or a field that there
  // is not and for a value of another type, IdError for a name that no part has.
  OperationArguments(const std::string &kind, const py::dict &fields, const Snapshot &valve);
  const mvs_op *get() const { return reinterpret_cast<const mvs_op *>(bytes_.data()); }

 private:
  void set(const mvs_field_info &field, const py::handle &value);
  void set_number(const mvs_field_info &field, const py::handle &value);
  void set_points(const mvs_field_info &field, const py::handle &value);
  mvs_site site_of(const mvs_field_info &field, const py::handle &value) const;
  mvs_id id_of(const mvs_field_info &field, uint32_t part_kind, const py::handle &value) const;
  std::string label(const mvs_field_info &field) const;
  template <typename T>
  void put(const mvs_field_info &field, const T &value);
  template <typename T>
  T cast(const mvs_field_info &field, const py::handle &value, const char *expected) const;

  std::string kind_;
  const Snapshot &valve_;
  std::vector<uint64_t> bytes_;
  std::deque<std::string> texts_;
  std::vector<py::array> arrays_;
};

// The name of a kind of operation: "chord_length".
std::string op_name(uint32_t kind);

// All kinds as a tuple of mvs.OperationKind.
py::tuple operations();

// The history of a snapshot as mvs.History.
py::object history_value(const Snapshot &snapshot);

}  // namespace mvs_python
