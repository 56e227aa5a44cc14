// Operations in C++: the kind of each struct, and the library's description of all kinds.
#ifndef MVS_OP_HPP
#define MVS_OP_HPP

#include <mvs/op.h>
#include <mvs/base.hpp>

#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace mvs {

// The number of an operation's struct: KindOf<mvs_op_clip>::value is MVS_OP_CLIP.
template <typename Op>
struct KindOf;
template <>
struct KindOf<mvs_op_chord_length> : std::integral_constant<std::uint32_t, MVS_OP_CHORD_LENGTH> {};
template <>
struct KindOf<mvs_op_chord_remove> : std::integral_constant<std::uint32_t, MVS_OP_CHORD_REMOVE> {};
template <>
struct KindOf<mvs_op_chord_add> : std::integral_constant<std::uint32_t, MVS_OP_CHORD_ADD> {};
template <>
struct KindOf<mvs_op_chord_transfer>
    : std::integral_constant<std::uint32_t, MVS_OP_CHORD_TRANSFER> {};
template <>
struct KindOf<mvs_op_annulus_scale> : std::integral_constant<std::uint32_t, MVS_OP_ANNULUS_SCALE> {
};
template <>
struct KindOf<mvs_op_ring> : std::integral_constant<std::uint32_t, MVS_OP_RING> {};
template <>
struct KindOf<mvs_op_band> : std::integral_constant<std::uint32_t, MVS_OP_BAND> {};
template <>
struct KindOf<mvs_op_neochord> : std::integral_constant<std::uint32_t, MVS_OP_NEOCHORD> {};
template <>
struct KindOf<mvs_op_head_move> : std::integral_constant<std::uint32_t, MVS_OP_HEAD_MOVE> {};
template <>
struct KindOf<mvs_op_clip> : std::integral_constant<std::uint32_t, MVS_OP_CLIP> {};
template <>
struct KindOf<mvs_op_resect> : std::integral_constant<std::uint32_t, MVS_OP_RESECT> {};
template <>
struct KindOf<mvs_op_patch> : std::integral_constant<std::uint32_t, MVS_OP_PATCH> {};

// A kind of operation as the library describes it.
struct OpKind {
  mvs_op_info info;
  std::vector<mvs_field_info> fields;
};

// Returns all kinds of the loaded library in the order of their numbers.
inline std::vector<OpKind> op_kinds() {
  std::vector<OpKind> kinds;
  for (std::uint32_t k = 0; k < mvs_get_op_count(); ++k) {
    OpKind kind = {filled<mvs_op_info>(mvs_get_op_info, k), {}};
    for (std::uint32_t f = 0; f < kind.info.fields; ++f) {
      kind.fields.push_back(filled<mvs_field_info>(mvs_get_op_field, k, f));
    }
    kinds.push_back(std::move(kind));
  }
  return kinds;
}

}  // namespace mvs

#endif
