// The instruction set of the processor, limited by the environment variable MVS_SIMD.
#include "base/simd.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace mvs::core {
namespace {

SimdLevel supported() {
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx512f")) return SimdLevel::avx512;
  if (__builtin_cpu_supports("avx2")) return SimdLevel::avx2;
#endif
  return SimdLevel::baseline;
}

SimdLevel allowed() {
  const char *asked = std::getenv("MVS_SIMD");
  const std::string_view name = asked ? asked : "";
  if (name == "baseline") return SimdLevel::baseline;
  return name == "avx2" ? SimdLevel::avx2 : SimdLevel::avx512;
}

}  // namespace

SimdLevel simd_level() {
  static const SimdLevel level = std::min(supported(), allowed());
  return level;
}

}  // namespace mvs::core
