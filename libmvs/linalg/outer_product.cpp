// Blocks a b^T as two registers of four numbers and a ninth number.
#include "linalg/outer_product.h"

#include "base/simd.h"

namespace mvs::core {
namespace {

#if defined(__GNUC__)

using Value = Double4::Value;

#if defined(__clang__)
#define MVS_PICK(v, a, b, c, d) __builtin_shufflevector(v, v, a, b, c, d)
#else
typedef long long Picks __attribute__((vector_size(32)));
#define MVS_PICK(v, a, b, c, d) __builtin_shuffle(v, Picks{a, b, c, d})
#endif

// The factors of a block a b^T, stored by columns, if a node is a (a0, a1) or b (b0, b1): of its
// first four, second four and last entries.
struct BlockFactors {
  Value a0, a1, b0, b1;
  double last;

  MVS_INLINE explicit BlockFactors(const double *slope) : last(slope[2]) {
    Value v;
    load<Double4>(v, slope);
    a0 = MVS_PICK(v, 0, 1, 2, 0);
    a1 = MVS_PICK(v, 1, 2, 0, 1);
    b0 = MVS_PICK(v, 0, 0, 0, 1);
    b1 = MVS_PICK(v, 1, 1, 2, 2);
  }
};

MVS_INLINE void add_block(double *block, const BlockFactors &a, const BlockFactors &b,
                          double times) {
  Value first, second;
  load<Double4>(first, block);
  load<Double4>(second, block + 4);
  const double last = block[8] + times * (a.last * b.last);
  first += times * (a.a0 * b.b0);
  second += times * (a.a1 * b.b1);
  store<Double4>(block, first);
  store<Double4>(block + 4, second);
  block[8] = last;
}

MVS_INLINE void add_pair(const OuterProductTarget &to, size_t pair, const BlockFactors &a,
                         const BlockFactors &b, double times) {
  if (to.lower[pair]) {
    add_block(to.pair[pair], a, b, times);
  } else {
    add_block(to.pair[pair], b, a, times);
  }
}

MVS_INLINE void add_blocks(const Slope &slope, double times, const OuterProductTarget &to) {
  const double *s = slope.number.data();
  const BlockFactors n0(s), n1(s + 3), n2(s + 6), n3(s + 9);
  add_block(to.diagonal[0], n0, n0, times);
  add_block(to.diagonal[1], n1, n1, times);
  add_block(to.diagonal[2], n2, n2, times);
  add_block(to.diagonal[3], n3, n3, times);
  add_pair(to, 0, n1, n0, times);
  add_pair(to, 1, n2, n0, times);
  add_pair(to, 2, n2, n1, times);
  add_pair(to, 3, n3, n0, times);
  add_pair(to, 4, n3, n1, times);
  add_pair(to, 5, n3, n2, times);
}

#else

void add_blocks(const Slope &slope, double times, const OuterProductTarget &to) {
  const auto add_block = [&](double *block, uint32_t a, uint32_t b) {
    Eigen::Map<Mat3>(block) += times * (slope.node(a) * slope.node(b).transpose());
  };
  for (uint32_t a = 0, pair = 0; a < 4; ++a) {
    add_block(to.diagonal[a], a, a);
    for (uint32_t b = 0; b < a; ++b, ++pair) {
      add_block(to.pair[pair], to.lower[pair] ? a : b, to.lower[pair] ? b : a);
    }
  }
}

#endif

}  // namespace

void add_outer_product(const Slope &slope, double times, const OuterProductTarget &to) {
  static const auto kernel = simd_kernel<&add_blocks>();
  kernel(slope, times, to);
}

}  // namespace mvs::core
