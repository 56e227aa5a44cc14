# Files of a target that are compiled as one, MVS_UNITY of them at a time: what they all include and
# instantiate is compiled once. scripts/demo and the short gate of scripts/test ask for it. What one
# file forgot another may bring, as with precompiled headers: the long gate compiles each file by
# itself. Off by default: a change to one file would compile its neighbours again.
set(MVS_UNITY "" CACHE STRING "How many files of a target are compiled as one; empty for none")
if(MVS_UNITY)
  set(CMAKE_UNITY_BUILD ON)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE ${MVS_UNITY})
endif()

# mvs_apart(FILE ...): by themselves all the same, because their own names are also those of others
function(mvs_apart)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
