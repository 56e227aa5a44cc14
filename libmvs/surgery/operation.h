// One operation with its values: an immutable deep copy of the caller's struct.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/types.h"
#include "surgery/kinds.h"

namespace mvs::core {

// Copies share one immutable value.
class Operation {
 public:
  // Throws MVS_E_ARGUMENT or MVS_E_VERSION for a struct that cannot be read or a value out of
  // range. perform() checks that the parts exist.
  explicit Operation(const mvs_op *given);

  const OpKind &kind() const { return *owned_->kind; }
  template <typename Struct>
  const Struct &as() const {
    return *reinterpret_cast<const Struct *>(owned_->bytes.data());
  }
  const mvs_op *get() const { return &as<mvs_op>(); }
  // Returns a field as its C type.
  template <typename Value>
  const Value &field(const OpField &f) const {
    return *reinterpret_cast<const Value *>(bytes() + f.offset);
  }

 private:
  struct Owned {
    const OpKind *kind;
    std::vector<uint64_t> bytes;  // the struct, in words for alignment
    std::vector<std::unique_ptr<std::vector<Vec3>>> points;
    std::vector<std::unique_ptr<std::string>> texts;
  };
  const char *bytes() const { return reinterpret_cast<const char *>(owned_->bytes.data()); }
  static void own(Owned &owned, const OpField &f);

  std::shared_ptr<const Owned> owned_;
};

// Returns the points of an array field of an Operation.
std::vector<Vec3> points_of(const mvs_array &array);

}  // namespace mvs::core
