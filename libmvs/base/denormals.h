// Sets the processor to flush denormals to zero (FTZ, DAZ) while an object of this class lives.
//
// The fill-in of a factor in single precision decays with the distance on the mesh, below 1e-38 for
// meshes of some thousand nodes. Arithmetic with denormals takes an Intel processor a hundred times
// as long (2.2 of 3.4 s of a closure with 6,800 vertices) and does not improve the factor.
//
// Threads that share a loop take over the mode of its caller: FloatingPointMode.
#pragma once

#if defined(__EMSCRIPTEN__)
// SSE2 is emulated there, and denormals cannot be flushed
#elif defined(__SSE2__) || defined(_M_X64)
#define MVS_HAVE_MXCSR
#include <xmmintrin.h>
#elif defined(__aarch64__)
#include <cstdint>
#endif

namespace mvs::core {

#if defined(MVS_HAVE_MXCSR)
class FlushDenormals {
 public:
  FlushDenormals() { _mm_setcsr(before_ | results_and_operands); }
  ~FlushDenormals() { _mm_setcsr(before_); }
  FlushDenormals(const FlushDenormals &) = delete;
  FlushDenormals &operator=(const FlushDenormals &) = delete;

 private:
  static constexpr unsigned results_and_operands = 0x8040;
  const unsigned before_ = _mm_getcsr();
};

// How a thread rounds and treats denormals.
class FloatingPointMode {
 public:
  static FloatingPointMode current() { return FloatingPointMode(_mm_getcsr()); }
  FloatingPointMode() = default;
  // Sets a mode while an object of this class lives.
  class Scope {
   public:
    explicit Scope(const FloatingPointMode &mode) { _mm_setcsr(mode.control_); }
    ~Scope() { _mm_setcsr(before_); }
    Scope(const Scope &) = delete;
    Scope &operator=(const Scope &) = delete;

   private:
    const unsigned before_ = _mm_getcsr();
  };

 private:
  explicit FloatingPointMode(unsigned control) : control_(control) {}
  unsigned control_ = 0x1f80;  // of a new process
};
#elif defined(__aarch64__) && defined(__GNUC__)
class FlushDenormals {
 public:
  FlushDenormals() { set(before_ | results_and_operands); }
  ~FlushDenormals() { set(before_); }
  FlushDenormals(const FlushDenormals &) = delete;
  FlushDenormals &operator=(const FlushDenormals &) = delete;

 private:
  static constexpr uint64_t results_and_operands = uint64_t{1} << 24;
  static uint64_t get() {
    uint64_t control;
    __asm__ volatile("mrs %0, fpcr" : "=r"(control));
    return control;
  }
  static void set(uint64_t control) { __asm__ volatile("msr fpcr, %0" ::"r"(control)); }
  const uint64_t before_ = get();
};

class FloatingPointMode {
 public:
  static FloatingPointMode current() { return FloatingPointMode(get()); }
  FloatingPointMode() = default;
  class Scope {
   public:
    explicit Scope(const FloatingPointMode &mode) { set(mode.control_); }
    ~Scope() { set(before_); }
    Scope(const Scope &) = delete;
    Scope &operator=(const Scope &) = delete;

   private:
    const uint64_t before_ = get();
  };

 private:
  explicit FloatingPointMode(uint64_t control) : control_(control) {}
  static uint64_t get() {
    uint64_t control;
    __asm__ volatile("mrs %0, fpcr" : "=r"(control));
    return control;
  }
  static void set(uint64_t control) { __asm__ volatile("msr fpcr, %0" ::"r"(control)); }
  uint64_t control_ = 0;
};
#else
class FlushDenormals {
 public:
  FlushDenormals() {}  // not constexpr, nor trivial: no warning of an unused object
  ~FlushDenormals() {}
};

class FloatingPointMode {
 public:
  static FloatingPointMode current() { return {}; }
  class Scope {
   public:
    explicit Scope(const FloatingPointMode &) {}
    ~Scope() {}
  };
};
#endif

}  // namespace mvs::core
