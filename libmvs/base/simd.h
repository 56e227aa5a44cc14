// SIMD: vector types with their masks, loads and stores, and the choice of an instruction set at
// run time. Kernels are written once over a vector type V and compiled for each instruction set by
// simd_kernel(). Every kernel gives the same bits on all of them: products and sums are not fused.
#pragma once

#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__SSE__)
#include <xmmintrin.h>
#endif

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace mvs::core {

enum class SimdLevel { baseline, avx2, avx512 };

// The widest instruction set of the processor, or a narrower one that the environment variable
// MVS_SIMD names (baseline, avx2, avx512), which the tests of equal bits use. Chosen at the first
// call.
SimdLevel simd_level();

// A vector type: `width` numbers in a register; Mask is the result of comparing two Values.
// Unaligned is a Value at any address: copied by memcpy, 32 bytes pass through the stack in halves.
// (Not a template: gcc drops the alignment of a typedef in one.) Compilers without vector
// extensions get one number.
#if defined(__GNUC__)
#define MVS_INLINE [[gnu::always_inline]] inline
#define MVS_RESTRICT __restrict
#define MVS_SIMD_TYPE(Name, T, Integer, count)                                           \
  struct Name {                                                                          \
    using Number = T;                                                                    \
    static constexpr uint32_t width = count;                                             \
    typedef T Value __attribute__((vector_size(count * sizeof(T))));                     \
    typedef Integer Mask __attribute__((vector_size(count * sizeof(T))));                \
    typedef T Unaligned                                                                  \
        __attribute__((vector_size(count * sizeof(T)), aligned(alignof(T)), may_alias)); \
  }
#else
#define MVS_INLINE inline
#define MVS_RESTRICT
#define MVS_SIMD_TYPE(Name, T, Integer, count) \
  struct Name {                                \
    using Number = T;                          \
    static constexpr uint32_t width = 1;       \
    typedef T Value;                           \
    typedef Integer Mask;                      \
    typedef T Unaligned;                       \
  }
#endif

MVS_SIMD_TYPE(Float4, float, int32_t, 4);
MVS_SIMD_TYPE(Float8, float, int32_t, 8);
MVS_SIMD_TYPE(Float16, float, int32_t, 16);
MVS_SIMD_TYPE(Double2, double, int64_t, 2);
MVS_SIMD_TYPE(Double4, double, int64_t, 4);
MVS_SIMD_TYPE(Double8, double, int64_t, 8);

// The registers of each instruction set by the type of their numbers.
template <typename T>
struct Registers;
template <>
struct Registers<float> {
  using Baseline = Float4;
  using Avx2 = Float8;
  using Avx512 = Float16;
};
template <>
struct Registers<double> {
  using Baseline = Double2;
  using Avx2 = Double4;
  using Avx512 = Double8;
};

// `from` and `to` need no alignment. By reference: the registers that pass a wide value depend on
// the instruction set.
template <typename V>
MVS_INLINE void load(typename V::Value &v, const typename V::Number *from) {
  v = *reinterpret_cast<const typename V::Unaligned *>(from);
}

template <typename V>
MVS_INLINE void store(typename V::Number *to, const typename V::Value &v) {
  *reinterpret_cast<typename V::Unaligned *>(to) = v;
}

// The numbers of a register without their signs.
template <typename Value>
MVS_INLINE void magnitude_of(const Value &v, Value &magnitude) {
  magnitude = v < -v ? -v : v;
}

// Bit k is set where element k of a mask is.
MVS_INLINE uint32_t bits_of_four(const Float4::Mask &mask) {
#if defined(__SSE__) && defined(__GNUC__)
  return static_cast<uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#elif defined(__GNUC__)
  const Float4::Mask bits = mask & Float4::Mask{1, 2, 4, 8};
  return static_cast<uint32_t>((bits[0] | bits[1]) | (bits[2] | bits[3]));
#else
  return mask & 1;
#endif
}

template <typename V>
MVS_INLINE uint32_t bits_of(const typename V::Mask &mask) {
  uint32_t bits = 0;
  for (uint32_t first = 0; first < V::width; first += Float4::width) {
    Float4::Mask part;
    std::memcpy(&part, reinterpret_cast<const char *>(&mask) + sizeof(int32_t) * first,
                sizeof part);
    bits |= bits_of_four(part) << first;
  }
  return bits;
}

// The same for a mask of doubles.
template <typename V>
MVS_INLINE uint32_t bits_of_doubles(const typename V::Mask &mask) {
  uint32_t bits = 0;
#if defined(__SSE2__) && defined(__GNUC__)
  for (uint32_t k = 0; k < V::width; k += 2) {
    __m128d half;
    std::memcpy(&half, reinterpret_cast<const char *>(&mask) + sizeof(double) * k, sizeof half);
    bits |= static_cast<uint32_t>(_mm_movemask_pd(half)) << k;
  }
#elif defined(__GNUC__)
  for (uint32_t k = 0; k < V::width; ++k) bits |= static_cast<uint32_t>(mask[k] & (1 << k));
#else
  bits = mask ? 1 : 0;
#endif
  return bits;
}

#if defined(__GNUC__)
// The sum of the elements, by halves.
MVS_INLINE float sum_of(const Float8::Value &v) {
  float part[8];
  store<Float8>(part, v);
  Float4::Value low, high;
  load<Float4>(low, part);
  load<Float4>(high, part + 4);
  const Float4::Value sum = low + high;
  return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

// Sets all but the first `count` elements to zero.
MVS_INLINE void keep_first(Float8::Value &v, size_t count) {
  static constexpr int32_t kept[16] = {-1, -1, -1, -1, -1, -1, -1, -1};
  Float8::Mask bits, keep;
  std::memcpy(&keep, kept + 8 - count, sizeof keep);
  std::memcpy(&bits, &v, sizeof bits);
  bits &= keep;
  std::memcpy(&v, &bits, sizeof bits);
}
#else
MVS_INLINE float sum_of(float v) {
  return v;
}
MVS_INLINE void keep_first(float &, size_t) {}
#endif

// A function compiled for each instruction set: MVS_INLINE code that it calls comes along.
template <auto function>
struct SimdVersions;

template <typename Result, typename... Arguments, Result (*function)(Arguments...)>
struct SimdVersions<function> {
  static Result baseline(Arguments... arguments) { return function(arguments...); }
#if defined(__x86_64__) && defined(__GNUC__)
  [[gnu::target("avx2")]] static Result avx2(Arguments... arguments) {
    return function(arguments...);
  }
  [[gnu::target("avx512f")]] static Result avx512(Arguments... arguments) {
    return function(arguments...);
  }
#endif
};

// The version of a kernel for simd_level(), as a function pointer to be kept in a static. The
// arguments are MVS_INLINE functions over vector types that suit each instruction set; without one
// for AVX-512 that of AVX2 serves there.
template <auto baseline, auto avx2 = baseline, auto avx512 = nullptr>
auto simd_kernel() {
#if defined(__x86_64__) && defined(__GNUC__)
  // not `avx512 != nullptr`, which is no constant to gcc 12 with -fsanitize=undefined
  if constexpr (!std::is_same_v<decltype(avx512), std::nullptr_t>) {
    if (simd_level() == SimdLevel::avx512) return &SimdVersions<avx512>::avx512;
  }
  if (simd_level() >= SimdLevel::avx2) return &SimdVersions<avx2>::avx2;
#endif
  return &SimdVersions<baseline>::baseline;
}

}  // namespace mvs::core
