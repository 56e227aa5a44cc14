#include "linalg/outer_product.h"

#include "base/simd.h"
#include "base/simd_level.h"

namespace mvs::core {
namespace {

#if defined(__GNUC__)

using Four = Wide<double, 4, 1>;
using Value = Four::Value;

#if defined(__clang__)
#define MVS_PICK(v, a, b, c, d) __builtin_shufflevector(v, v, a, b, c, d)
#else
typedef long long Picks __attribute__((vector_size(32)));
#define MVS_PICK(v, a, b, c, d) __builtin_shuffle(v, Picks{a, b, c, d})
#endif

// A node's three numbers as a block a b^T has them, column by column: those of a and those of b in
// its first, second and last place.
struct Spread {
  Value a0, a1, b0, b1;
  double last;

  MVS_INLINE explicit Spread(const double *slope) : last(slope[2]) {
    Value v;
    load<Four>(v, slope);
    a0 = MVS_PICK(v, 0, 1, 2, 0);
    a1 = MVS_PICK(v, 1, 2, 0, 1);
    b0 = MVS_PICK(v, 0, 0, 0, 1);
    b1 = MVS_PICK(v, 1, 1, 2, 2);
  }
};

MVS_INLINE void add_block(double *block, const Spread &a, const Spread &b, double times) {
  Value first, second;
  load<Four>(first, block);
  load<Four>(second, block + 4);
  const double last = block[8] + times * (a.last * b.last);
  first += times * (a.a0 * b.b0);
  second += times * (a.a1 * b.b1);
  store<Four>(block, first);
  store<Four>(block + 4, second);
  block[8] = last;
}

MVS_INLINE void add_pair(const OuterProductTarget &to, size_t pair, const Spread &a,
                         const Spread &b, double times) {
  if (to.lower[pair]) {
    add_block(to.pair[pair], a, b, times);
  } else {
    add_block(to.pair[pair], b, a, times);
  }
}

MVS_INLINE void add(const Slope &slope, double times, const OuterProductTarget &to) {
  const double *s = slope.number.data();
  const Spread n0(s), n1(s + 3), n2(s + 6), n3(s + 9);
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

void add(const Slope &slope, double times, const OuterProductTarget &to) {
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

void add_plain(const Slope &slope, double times, const OuterProductTarget &to) {
  add(slope, times, to);
}

#if defined(__x86_64__) && defined(__GNUC__)
[[gnu::target("avx2")]] void add_wider(const Slope &slope, double times,
                                       const OuterProductTarget &to) {
  add(slope, times, to);
}
#endif

using Kernel = void (*)(const Slope &, double, const OuterProductTarget &);

Kernel choose() {
#if defined(__x86_64__) && defined(__GNUC__)
  if (simd_level() >= SimdLevel::avx2) return &add_wider;
#endif
  return &add_plain;
}

}  // namespace

void add_outer_product(const Slope &slope, double times, const OuterProductTarget &to) {
  static const Kernel kernel = choose();
  kernel(slope, times, to);
}

}  // namespace mvs::core
