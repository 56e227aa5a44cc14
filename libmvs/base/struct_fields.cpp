// structs.def as tables; the compiler checks that every field of each struct has its row.
#include "base/struct_fields.h"

#include <mvs/cost.h>
#include <mvs/profile.h>
#include <mvs/snapshot.h>

#include <cstddef>
#include <limits>
#include <type_traits>

namespace mvs::core {
namespace {

constexpr size_t size_of(uint32_t type) {
  return type == MVS_FIELD_COUNT ? sizeof(uint32_t) : sizeof(double);
}

constexpr mvs_field_info row(uint32_t type, size_t offset, const char *name, const char *unit,
                             const char *label, const char *help) {
  mvs_field_info field = {};
  field.struct_size = sizeof field;
  field.type = type;
  field.offset = static_cast<uint32_t>(offset);
  field.name = name;
  field.label = label;
  field.unit = unit;
  field.help = help;
  field.choices = "";
  field.default_text = "";
  field.default_value = std::numeric_limits<double>::quiet_NaN();
  field.group_name = "";
  return field;
}

// The bit of each group of measures, by its word.
namespace group {
constexpr uint32_t none = 0;
constexpr uint32_t crossings = MVS_MEASURE_GROUP_CROSSINGS;
constexpr uint32_t orifice = MVS_MEASURE_GROUP_ORIFICE;
constexpr uint32_t coaptation = MVS_MEASURE_GROUP_COAPTATION;
constexpr uint32_t tenting = MVS_MEASURE_GROUP_TENTING;
constexpr uint32_t annulus = MVS_MEASURE_GROUP_ANNULUS;
constexpr uint32_t chords = MVS_MEASURE_GROUP_CHORDS;
constexpr uint32_t leaflets = MVS_MEASURE_GROUP_LEAFLETS;
}  // namespace group

constexpr mvs_field_info in_group(mvs_field_info field, uint32_t bit, const char *word) {
  field.group = bit;
  field.group_name = bit != 0 ? word : "";
  return field;
}

#define MEASURE(GROUP, TYPE, name, unit, label, help)                                     \
  in_group(row(MVS_FIELD_##TYPE, offsetof(mvs_measures, name), #name, unit, label, help), \
           group::GROUP, #GROUP),
constexpr mvs_field_info measures_fields[] = {
#include "base/structs.def"
};
#define COST(TYPE, name, unit, label, help) \
  row(MVS_FIELD_##TYPE, offsetof(mvs_cost, name), #name, unit, label, help),
constexpr mvs_field_info cost_fields[] = {
#include "base/structs.def"
};
#define STAT(TYPE, name, unit, help) \
  row(MVS_FIELD_##TYPE, offsetof(mvs_stats, name), #name, unit, #name, help),
constexpr mvs_field_info stats_fields[] = {
#include "base/structs.def"
};
#define PROFILE(TYPE, name, member, unit, help) \
  row(MVS_FIELD_##TYPE, offsetof(mvs_profile, member), #name, unit, #name, help),
constexpr mvs_field_info profile_fields[] = {
#include "base/structs.def"
};

// Whether rows lie one after the other from behind struct_size to `size`, but for a reserved
// uint32_t.
template <size_t count>
constexpr bool covers(const mvs_field_info (&fields)[count], size_t size) {
  size_t end = sizeof(uint32_t);
  for (const mvs_field_info &field : fields) {
    if (field.offset < end || field.offset > end + sizeof(uint32_t)) return false;
    end = field.offset + size_of(field.type);
  }
  return end == size;
}
static_assert(covers(measures_fields, sizeof(mvs_measures)));
static_assert(covers(cost_fields, sizeof(mvs_cost)));
static_assert(covers(stats_fields, sizeof(mvs_stats)));
static_assert(covers(profile_fields, sizeof(mvs_profile)));

// The type of each row is that of its field.
#define MEASURE(GROUP, TYPE, name, unit, label, help) \
  static_assert(                                      \
      std::is_same_v<decltype(mvs_measures::name),    \
                     std::conditional_t<MVS_FIELD_##TYPE == MVS_FIELD_COUNT, uint32_t, double>>);
#define COST(TYPE, name, unit, label, help)    \
  static_assert(                               \
      std::is_same_v<decltype(mvs_cost::name), \
                     std::conditional_t<MVS_FIELD_##TYPE == MVS_FIELD_COUNT, uint32_t, double>>);
#define STAT(TYPE, name, unit, help)            \
  static_assert(                                \
      std::is_same_v<decltype(mvs_stats::name), \
                     std::conditional_t<MVS_FIELD_##TYPE == MVS_FIELD_COUNT, uint32_t, double>>);
#include "base/structs.def"

}  // namespace

std::span<const mvs_field_info> struct_fields(mvs_struct which) {
  if (which == MVS_STRUCT_MEASURES) return measures_fields;
  if (which == MVS_STRUCT_STATS) return stats_fields;
  if (which == MVS_STRUCT_PROFILE) return profile_fields;
  if (which == MVS_STRUCT_COST) return cost_fields;
  return {};
}

mvs_measure_group_flags all_measure_groups() {
  mvs_measure_group_flags all = 0;
  for (const mvs_field_info &field : measures_fields) all |= field.group;
  return all;
}

}  // namespace mvs::core
