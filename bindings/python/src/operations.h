// Converts operations of mvs.ops to the structs of the C interface, from its description of them.
#pragma once

#include <mvs/op.h>

#include <list>
#include <string>
#include <vector>

#include "arrays.h"

namespace mvs_python {

// The struct of an operation; owns the memory that it points to.
class OpStruct {
 public:
  // `operation` is a mvs.ops.Operation; names of parts are looked up in `snapshot`.
  OpStruct(const py::object &operation, const py::object &snapshot);
  const mvs_op *get() const { return reinterpret_cast<const mvs_op *>(words_.data()); }

 private:
  void write(uint32_t type, uint32_t offset, const py::object &value);
  template <typename Value>
  Value &at(uint32_t offset) {
    return *reinterpret_cast<Value *>(reinterpret_cast<char *>(words_.data()) + offset);
  }

  std::vector<uint64_t> words_;  // the struct, aligned
  std::vector<py::array> kept_;
  std::list<std::string> texts_;
};

// The results of mvs_get_op_info as a list of dictionaries.
py::list op_kinds();

}  // namespace mvs_python
