// How a thread rounds and treats denormals; FlushDenormals flushes them to zero (FTZ, DAZ) while it
// lives.
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

// The register that controls the floating-point arithmetic of the calling thread.
namespace floating_point {
#if defined(MVS_HAVE_MXCSR)
using Control = unsigned;
inline constexpr Control initial = 0x1f80, flush_results_and_operands = 0x8040;
inline Control get() {
  return _mm_getcsr();
}
inline void set(Control control) {
  _mm_setcsr(control);
}
#elif defined(__aarch64__) && defined(__GNUC__)
using Control = uint64_t;
inline constexpr Control initial = 0, flush_results_and_operands = Control{1} << 24;
inline Control get() {
  Control control;
  __asm__ volatile("mrs %0, fpcr" : "=r"(control));
  return control;
}
inline void set(Control control) {
  __asm__ volatile("msr fpcr, %0" ::"r"(control));
}
#else
using Control = unsigned;
inline constexpr Control initial = 0, flush_results_and_operands = 0;
inline Control get() {
  return initial;
}
inline void set(Control) {}
#endif
}  // namespace floating_point

class FloatingPointMode {
 public:
  FloatingPointMode() = default;  // of a new process
  static FloatingPointMode current() { return FloatingPointMode(floating_point::get()); }
  FloatingPointMode with_flushed_denormals() const {
    return FloatingPointMode(control_ | floating_point::flush_results_and_operands);
  }
  // Sets a mode while an object of this class lives.
  class Scope {
   public:
    explicit Scope(const FloatingPointMode &mode) { floating_point::set(mode.control_); }
    ~Scope() { floating_point::set(before_); }
    Scope(const Scope &) = delete;
    Scope &operator=(const Scope &) = delete;

   private:
    const floating_point::Control before_ = floating_point::get();
  };

 private:
  explicit FloatingPointMode(floating_point::Control control) : control_(control) {}
  floating_point::Control control_ = floating_point::initial;
};

class FlushDenormals {
 public:
  FlushDenormals() : scope_(FloatingPointMode::current().with_flushed_denormals()) {}

 private:
  const FloatingPointMode::Scope scope_;
};

}  // namespace mvs::core
