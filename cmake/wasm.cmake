# WebAssembly, built with emscripten (emcmake cmake --preset wasm; scripts/js does that).
#
# -msimd128 gives the vectors of the kernels (libmvs/base/simd.h). -msse2 has Eigen use its packets of
# SSE, which emscripten maps onto simd128: without them Eigen sums in another order, and the results
# have other bits than native ones. Relaxed SIMD is never used: its results depend on the processor.
if(NOT EMSCRIPTEN)
  return()
endif()
# Eigen 3.4 takes clang for gcc 4.2. Before gcc 6.3 (10 * major + minor >= 63) it has minimum and maximum
# as x86 assembly, from gcc 6.0 on constraints of x86 in asm statements: 5.13 has neither.
add_compile_options(-fwasm-exceptions -msimd128 -msse2 -fgnuc-version=5.13.0)
add_link_options(-fwasm-exceptions)
set(CMAKE_POSITION_INDEPENDENT_CODE OFF)

# Headers without code, from the host. /usr/include itself must not be searched, because its other
# headers are not those of emscripten's C library: a folder that holds links is.
set(wasm_include ${CMAKE_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${wasm_include})
foreach(package Eigen3:eigen3/Eigen/Core:Eigen nlohmann_json:nlohmann/json.hpp:nlohmann)
  string(REPLACE ":" ";" package ${package})
  list(GET package 0 name)
  list(GET package 1 header)
  list(GET package 2 folder)
  find_file(MVS_HOST_${name} ${header} PATHS /usr/include /usr/local/include REQUIRED
    NO_CMAKE_FIND_ROOT_PATH)
  get_filename_component(found ${MVS_HOST_${name}} DIRECTORY)
  file(CREATE_LINK ${found} ${wasm_include}/${folder} SYMBOLIC)
endforeach()
# Eigen names this header for SSE; of MMX it uses nothing, and emscripten has none. Both headers are only
# written where they differ: newer ones would have everything compiled again.
file(CONFIGURE OUTPUT ${wasm_include}/mmintrin.h CONTENT "#pragma once\n" @ONLY)
# Clang 14 merges the load of a number with its copy to both halves of a register (v128.load64_splat), and
# then moves stores before that load: p = turn * p + shift read z after it was written. The empty asm keeps
# load and copy apart. The golden scenes with rings (bindings/js/test/golden.test.mjs) show the fault.
file(CONFIGURE OUTPUT ${wasm_include}/emmintrin.h CONTENT [=[
#pragma once
#include_next <emmintrin.h>
static __inline__ __m128d __attribute__((__always_inline__)) mvs_set1_pd(double value) {
  __asm__("" : "+r"(value));
  return (__m128d)wasm_f64x2_splat(value);
}
#define _mm_set1_pd mvs_set1_pd
]=] @ONLY)
foreach(target Eigen3::Eigen nlohmann_json::nlohmann_json)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${wasm_include})
endforeach()
