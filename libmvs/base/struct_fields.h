// Descriptions of the fields of mvs_measures, mvs_cost, mvs_stats and mvs_profile, made from
// structs.def.
#pragma once

#include <mvs/base.h>
#include <mvs/snapshot.h>

#include <cstring>
#include <span>

namespace mvs::core {

// The fields of MVS_STRUCT_MEASURES, ... in the order of the struct; empty for an unknown number.
std::span<const mvs_field_info> struct_fields(mvs_struct which);

// All bits MVS_MEASURE_GROUP_*.
mvs_measure_group_flags all_measure_groups();

// Reads and writes a field of a struct as a number; a COUNT is converted.
inline double read_field(const void *from, const mvs_field_info &field) {
  const char *at = static_cast<const char *>(from) + field.offset;
  if (field.type == MVS_FIELD_COUNT) {
    uint32_t count = 0;
    std::memcpy(&count, at, sizeof count);
    return count;
  }
  double number = 0;
  std::memcpy(&number, at, sizeof number);
  return number;
}

inline void write_field(void *to, const mvs_field_info &field, double value) {
  char *at = static_cast<char *>(to) + field.offset;
  if (field.type == MVS_FIELD_COUNT) {
    const auto count = static_cast<uint32_t>(value);
    std::memcpy(at, &count, sizeof count);
  } else {
    std::memcpy(at, &value, sizeof value);
  }
}

}  // namespace mvs::core
