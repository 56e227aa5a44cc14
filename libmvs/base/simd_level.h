// Which vector extension the kernels use: the widest one of the processor, or less where the
// environment variable MVS_SIMD says so (baseline, avx2, avx512), which the tests of equal bits do.
#pragma once

namespace mvs::core {

enum class SimdLevel { baseline, avx2, avx512 };

// Decided at the first call.
SimdLevel simd_level();

}  // namespace mvs::core
