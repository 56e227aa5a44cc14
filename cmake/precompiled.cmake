# Eigen, the standard library and doctest take 1.2 s of each of our C++ files under clang, 1.5 s
# under gcc; MVS_PRECOMPILED has them read once: "tests" for the doctest programs, "all" for the
# library, the command and the Python module too. scripts/demo and the short gate of scripts/test ask
# for "all". A file that forgot an include compiles then; clang-tidy, which reads every changed file
# by itself, still refuses it, and so do the long gate and every build that did not ask.
# Off by default: ccache keeps no objects that were compiled this way.
set(MVS_PRECOMPILED "" CACHE STRING "Whose headers are precompiled: tests, all, or nobody's")
set_property(CACHE MVS_PRECOMPILED PROPERTY STRINGS "" tests all)

set(mvs_common_headers <Eigen/Eigenvalues> <Eigen/Geometry> <Eigen/LU>
  <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <cstdio> <cstdlib> <cstring> <filesystem>
  <fstream> <functional> <limits> <map> <memory> <mutex> <numeric> <optional> <set> <span> <sstream>
  <stdexcept> <string> <string_view> <thread> <utility> <vector>)

# mvs_precompiled(NAME LIBRARIES ... HEADERS ...): headers that are compiled once, as target NAME
function(mvs_precompiled name)
  cmake_parse_arguments(of "" "" "LIBRARIES;HEADERS" ${ARGN})
  file(CONFIGURE OUTPUT ${name}.cpp CONTENT "// its headers are all there is to it\n")
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE mvs_flags ${of_LIBRARIES})
  target_precompile_headers(${name} PRIVATE ${of_HEADERS})
  target_compile_options(${name} PRIVATE -fPIC)
endfunction()

# mvs_precompile(TARGET NAME): the target reads what NAME has compiled, which has to be there
function(mvs_precompile target name)
  if(TARGET ${name})
    target_precompile_headers(${target} REUSE_FROM ${name})
    # programs are -fPIE by themselves, and then could not
    target_compile_options(${target} PRIVATE -fPIC)
  endif()
endfunction()
