// Vectors in registers, as wide as a function's target has them: for the dense kernels.
#pragma once

#include <cstddef>
#include <cstring>

namespace mvs::core {

// A tile is `vectors` of them high.
#if defined(__GNUC__)
#define MVS_INLINE [[gnu::always_inline]] inline
#define MVS_RESTRICT __restrict
template <typename T, size_t count, size_t vectors_in>
struct Wide {
  using Number = T;
  static constexpr size_t lanes = count, vectors = vectors_in, height = lanes * vectors;
  typedef T Value __attribute__((vector_size(sizeof(T) * count)));
};
#else
#define MVS_INLINE inline
#define MVS_RESTRICT
template <typename T, size_t, size_t vectors_in>
struct Wide {
  using Number = T;
  static constexpr size_t lanes = 1, vectors = vectors_in, height = vectors;
  typedef T Value;
};
#endif

// Numbers lie anywhere: a reference to them as a vector would promise more than that (clang then
// reads them as aligned).
template <typename V>
MVS_INLINE void load(typename V::Value &v, const typename V::Number *from) {
  std::memcpy(&v, from, sizeof v);
}

template <typename V>
MVS_INLINE void store(typename V::Number *to, const typename V::Value &v) {
  std::memcpy(to, &v, sizeof v);
}

// By halves.
template <typename V>
MVS_INLINE typename V::Number sum_of(const typename V::Value &v) {
  typename V::Number part[V::lanes];
  std::memcpy(part, &v, sizeof part);
  if constexpr (V::lanes == 1) {
    return part[0];
  } else {
    using Half = Wide<typename V::Number, V::lanes / 2, 1>;
    typename Half::Value low, high;
    load<Half>(low, part);
    load<Half>(high, part + V::lanes / 2);
    return sum_of<Half>(low + high);
  }
}

// Leaves the first `count` of eight floats, and zeros.
#if defined(__GNUC__)
MVS_INLINE void keep_first(Wide<float, 8, 1>::Value &v, size_t count) {
  typedef int Bits __attribute__((vector_size(32)));
  static constexpr int kept[16] = {-1, -1, -1, -1, -1, -1, -1, -1};
  Bits bits, keep;
  std::memcpy(&keep, kept + 8 - count, sizeof keep);
  std::memcpy(&bits, &v, sizeof bits);
  bits &= keep;
  std::memcpy(&v, &bits, sizeof bits);
}
#else
MVS_INLINE void keep_first(float &, size_t) {}
#endif

}  // namespace mvs::core
