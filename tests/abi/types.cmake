# Compares the types that LIBRARY exports with the baseline. After a change that is meant, such as a
# field at the end of a struct with struct_size, make a new baseline:
#   cmake --preset dev && cmake --build --preset dev --target abi_baseline
# No suppression lets such fields pass by themselves: with "has_data_member_inserted_at = end"
# libabigail 2.2 lets moved fields pass as well.
if(NOT ABIDIFF OR NOT ABIDW)
  message(STATUS "skipped: abidw and abidiff (abigail-tools) are not installed")
  return()
endif()
if(NOT BUILD_TYPE MATCHES "Deb")
  message(STATUS "skipped: build type ${BUILD_TYPE} has no debug information")
  return()
endif()
execute_process(COMMAND ${ABIDW} --drop-private-types --exported-interfaces-only
  --headers-dir ${SOURCE}/include --no-show-locs --no-corpus-path --no-comp-dir-path --no-elf-needed
  --out-file ${NEW} ${LIBRARY} RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "abidw failed with ${failed}")
endif()
# files by their place in the sources, wherever those lie
file(READ ${NEW} types)
string(REPLACE "path='${SOURCE}/" "path='" types "${types}")
file(WRITE ${NEW} "${types}")
if(UPDATE)
  file(COPY ${NEW} DESTINATION ${FOLDER})
  message(STATUS "new baseline ${FOLDER}/mvs.abi")
  return()
endif()
execute_process(COMMAND ${ABIDIFF} --no-added-syms --suppressions ${FOLDER}/opaque.ini
  ${FOLDER}/mvs.abi ${NEW} RESULT_VARIABLE changed OUTPUT_VARIABLE report)
if(changed)
  message(FATAL_ERROR "the binary interface changed:\n${report}")
endif()
message(STATUS "types as in the baseline")
