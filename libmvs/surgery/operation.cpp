// Reads operations: struct sizes, ranges of fields, deep copies of arrays and texts.
#include "surgery/operation.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/array_view.h"
#include "base/error.h"
#include "base/utf8.h"
#include "model/text.h"

namespace mvs::core {
namespace {

// "chord_length.factor"
std::string name_of(const OpKind &kind, const OpField &f) {
  return format("%s.%s", kind.name, f.name);
}

// A hint if a value in m above its limit is in range as mm.
const char *mm_hint(const char *unit, double value, double limit) {
  const double size = std::abs(value);
  const bool millimetres = std::strcmp(unit, "m") == 0 && size > limit && size <= 1e3 * limit;
  return millimetres ? ": looks like mm given as m" : "";
}

void check_number(const OpKind &kind, const OpField &f, double value) {
  if (value == 0 && !f.required) return;
  MVS_MUST(value >= f.low && value <= f.high, MVS_E_ARGUMENT, name_of(kind, f),
           "%s: %s is %g%s%s, it has to be %g to %g%s", kind.name, f.name, value,
           *f.unit ? " " : "", f.unit, f.low, f.high, mm_hint(f.unit, value, f.high));
}

void check_count(const OpKind &kind, const OpField &f, uint32_t value) {
  if (value == 0 && !f.required) return;
  const std::string most =
      *f.choices ? format("one of %s", f.choices) : format("%.0f to %.0f", f.low, f.high);
  MVS_MUST(value >= f.low && value <= f.high, MVS_E_ARGUMENT, name_of(kind, f),
           "%s: %s is %u, it has to be %s", kind.name, f.name, value, most.c_str());
}

void check_site(const OpKind &kind, const OpField &f, const mvs_site &site) {
  MVS_MUST(site.how != MVS_SITE_NONE || !f.required, MVS_E_ARGUMENT, name_of(kind, f),
           "%s: %s is not given: name a node, a triangle or a scallop", kind.name, f.name);
  MVS_MUST(site.how <= MVS_SITE_ANATOMICAL, MVS_E_ARGUMENT, name_of(kind, f),
           "%s: %s.how is %u, it has to be one of MVS_SITE_*", kind.name, f.name, site.how);
  MVS_MUST(site.how != MVS_SITE_ANATOMICAL || site.scallop != 0, MVS_E_ID, name_of(kind, f),
           "%s: %s.scallop is not given: find its id by its name", kind.name, f.name);
  for (const double u : site.u) {
    MVS_MUST(u >= -1e-9 && u <= 1 + 1e-9, MVS_E_ARGUMENT, name_of(kind, f),
             "%s: %s has a coordinate of %g, it has to be 0 to 1", kind.name, f.name, u);
  }
  const double sum = site.u[0] + site.u[1] + site.u[2];
  MVS_MUST(site.how != MVS_SITE_TRIANGLE || std::abs(sum - 1) < 1e-6, MVS_E_ARGUMENT,
           name_of(kind, f), "%s: the barycentric coordinates of %s sum up to %g, not 1", kind.name,
           f.name, sum);
}

void check_coordinates(const OpKind &kind, const OpField &f, const double *at, double limit) {
  for (int k = 0; k < 3; ++k) {
    MVS_MUST(std::abs(at[k]) <= limit, MVS_E_ARGUMENT, name_of(kind, f),
             "%s: %s has a coordinate of %g m, it has to be within %g m%s", kind.name, f.name,
             at[k], limit, mm_hint("m", at[k], limit));
  }
}

// Largest distance of a patient's valve from the origin of a scanner, m.
constexpr double farthest = 10;

void check_value(const OpKind &kind, const OpField &f, const void *at) {
  switch (f.type) {
    case MVS_FIELD_NUMBER:
      return check_number(kind, f, *static_cast<const double *>(at));
    case MVS_FIELD_COUNT:
    case MVS_FIELD_CHOICE:
      return check_count(kind, f, *static_cast<const uint32_t *>(at));
    case MVS_FIELD_CHORD:
    case MVS_FIELD_HEAD:
    case MVS_FIELD_SCALLOP:
      MVS_MUST(!f.required || *static_cast<const mvs_id *>(at) != 0, MVS_E_ID, name_of(kind, f),
               "%s: %s is not given: find its id by its name", kind.name, f.name);
      return;
    case MVS_FIELD_SITE:
      return check_site(kind, f, *static_cast<const mvs_site *>(at));
    case MVS_FIELD_POINT: {
      const auto &point = *static_cast<const mvs_point *>(at);
      MVS_MUST(point.given <= 1 && point.reserved == 0, MVS_E_ARGUMENT, name_of(kind, f),
               "%s: %s.given has to be 0 or 1, %s.reserved 0", kind.name, f.name, f.name);
      return check_coordinates(kind, f, point.at, farthest);
    }
    case MVS_FIELD_VECTOR:
      return check_coordinates(kind, f, static_cast<const double *>(at), f.high);
    default:
      return;  // arrays and texts are checked in own()
  }
}

void check_points(const OpKind &kind, const OpField &f, const std::vector<Vec3> &points) {
  const auto count = static_cast<double>(points.size());
  MVS_MUST(points.empty() || (count >= f.low && count <= f.high), MVS_E_ARGUMENT, name_of(kind, f),
           "%s: %s has %zu points, it has to have %.0f to %.0f", kind.name, f.name, points.size(),
           f.low, f.high);
  for (const Vec3 &p : points) check_coordinates(kind, f, p.data(), farthest);
}

void check_text(const OpKind &kind, const OpField &f, const std::string &text) {
  MVS_MUST(is_plain_text(text) && static_cast<double>(text.size()) <= f.high, MVS_E_ARGUMENT,
           name_of(kind, f),
           "%s: %s has %zu bytes or a control character; at most %.0f printable ones", kind.name,
           f.name, text.size(), f.high);
  MVS_MUST(is_utf8(text), MVS_E_ARGUMENT, name_of(kind, f),
           "%s: %s is not UTF-8: names are UTF-8, convert it", kind.name, f.name);
}

// Returns the struct size that the caller set: at least the common head, at most a plausible
// maximum.
uint32_t checked_size(const mvs_op *given) {
  MVS_MUST(given != nullptr, MVS_E_ARGUMENT, "op", "op is a null pointer");
  uint32_t size = 0;
  std::memcpy(&size, given, sizeof size);
  MVS_MUST(size >= sizeof(mvs_op) && size <= 4096 && size % 4 == 0, MVS_E_ARGUMENT, "op",
           "op.struct_size is %u: set it to sizeof the operation's struct", size);
  return size;
}

}  // namespace

Operation::Operation(const mvs_op *given) {
  const uint32_t size = checked_size(given);
  MVS_MUST(given->kind != 0, MVS_E_ARGUMENT, "op",
           "op.kind is not set: it has to be one of MVS_OP_*");
  const OpKind *kind = find_op_kind(given->kind);
  MVS_MUST(kind != nullptr, MVS_E_VERSION, "op",
           "op.kind is %u, which this version of libmvs does not know", given->kind);
  const char *from = reinterpret_cast<const char *>(given);
  for (uint32_t k = kind->size; k < size; ++k) {
    MVS_MUST(from[k] == 0, MVS_E_VERSION, "op",
             "%s has a field at byte %u that this version of libmvs does not know: update libmvs, "
             "or leave the field zero",
             kind->name, k);
  }
  auto owned = std::make_shared<Owned>();
  owned->kind = kind;
  owned->bytes.assign((kind->size + 7) / 8, 0);
  std::memcpy(owned->bytes.data(), from, std::min(size, kind->size));
  std::memcpy(owned->bytes.data(), &kind->size, sizeof kind->size);
  const char *bytes = reinterpret_cast<const char *>(owned->bytes.data());
  for (const OpField &f : kind->fields) {
    check_value(*kind, f, bytes + f.offset);
    own(*owned, f);
  }
  owned_ = std::move(owned);
}

// Copies the array or text of a pointer field and redirects the field to the copy.
void Operation::own(Owned &owned, const OpField &f) {
  char *at = reinterpret_cast<char *>(owned.bytes.data()) + f.offset;
  if (f.type == MVS_FIELD_POINTS) {
    auto &array = *reinterpret_cast<mvs_array *>(at);
    auto points =
        std::make_unique<std::vector<Vec3>>(read_points(array, name_of(*owned.kind, f).c_str()));
    check_points(*owned.kind, f, *points);
    array = {points->empty() ? nullptr : points->data(), points->size(), points->empty() ? 0u : 3u,
             points->empty() ? 0u : uint32_t{MVS_TYPE_F64}, 0};
    owned.points.push_back(std::move(points));
  } else if (f.type == MVS_FIELD_TEXT) {
    auto &text = *reinterpret_cast<const char **>(at);
    if (text == nullptr) return;
    auto copy = std::make_unique<std::string>(text);
    check_text(*owned.kind, f, *copy);
    text = copy->c_str();
    owned.texts.push_back(std::move(copy));
  }
}

std::vector<Vec3> points_of(const mvs_array &array) {
  const auto *first = static_cast<const Vec3 *>(array.data);
  return {first, first + array.count};
}

}  // namespace mvs::core
