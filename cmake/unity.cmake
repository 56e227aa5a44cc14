# Files of a target that are compiled as one, MVS_UNITY of them at a time: their common headers and
# instantiations are compiled once. scripts/demo, the short gate of scripts/test and its sanitizers ask
# for it. A forgotten include may come from another file of the group, as with precompiled headers: the
# long gate compiles each file by itself with gcc and clang. Off by default: a change to one file would
# compile its neighbours again.
set(MVS_UNITY "" CACHE STRING "How many files of a target are compiled as one; empty for none")
if(MVS_UNITY)
  set(CMAKE_UNITY_BUILD ON)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE ${MVS_UNITY})
endif()

# mvs_apart(FILE ...): by themselves all the same, because their own names are also those of others
function(mvs_apart)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
