# Files of a target that are compiled as one, MVS_UNITY of them at a time: what they all include and
# instantiate is compiled once. scripts/test asks for it where there is no ccache. What one file
# forgot another may bring, as with headers that are precompiled (precompiled.cmake says who sees it).
# Of no files by default: a change to one would compile its neighbours again.
set(MVS_UNITY "" CACHE STRING "How many files of a target are compiled as one; empty for none")
if(MVS_UNITY)
  set(CMAKE_UNITY_BUILD ON)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE ${MVS_UNITY})
endif()

# mvs_apart(FILE ...): by themselves all the same, because their own names are also those of others
function(mvs_apart)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# mvs_own_names(TARGET NAME ...): names that many of its files have; compiled as one, each file's are
# marked by the file
function(mvs_own_names target)
  set(code "#define MVS_JOINED(a, b) a##_##b\n#define MVS_OWN(a, b) MVS_JOINED(a, b)")
  foreach(name ${ARGN})
    string(APPEND code "\n#define ${name} MVS_OWN(${name}, MVS_FILE)")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_UNIQUE_ID MVS_FILE
    UNITY_BUILD_CODE_BEFORE_INCLUDE "${code}")
endfunction()
