// Enumerates the fields of the result structs: the rows of base/structs.def.
#include "base/struct_fields.h"

#include "api/structs.h"

using namespace mvs::core;

extern "C" {

uint32_t mvs_get_field_count(mvs_struct which) {
  return static_cast<uint32_t>(struct_fields(which).size());
}

mvs_result mvs_get_field(mvs_struct which, uint32_t index, mvs_field_info *field) {
  return at_boundary([&] {
    const std::span<const mvs_field_info> fields = struct_fields(which);
    MVS_MUST(!fields.empty(), MVS_E_ARGUMENT, "which",
             "which is %u: it has to be one of MVS_STRUCT_*", which);
    MVS_MUST(index < fields.size(), MVS_E_ARGUMENT, "index",
             "index is %u, but the struct has %zu fields", index, fields.size());
    write_struct(field, fields[index], "field");
  });
}

}  // extern "C"
