# Compares the types that LIBRARY exports with the baseline. After a change that is meant, such as a
# field at the end of a struct with struct_size, make a new baseline with the command that
# ctest -V -R abi_types shows, and -DUPDATE=ON before its -P. No suppression lets such fields pass by
# themselves: with "has_data_member_inserted_at = end" libabigail 2.2 lets moved fields pass as well.
if(NOT ABIDIFF OR NOT ABIDW)
  message(STATUS "skipped: abidw and abidiff (abigail-tools) are not installed")
  return()
endif()
if(NOT BUILD_TYPE MATCHES "Deb")
  message(STATUS "skipped: build type ${BUILD_TYPE} has no debug information")
  return()
endif()
execute_process(COMMAND ${ABIDW} --drop-private-types --exported-interfaces-only
  --headers-dir ${HEADERS} --no-show-locs --no-corpus-path --no-comp-dir-path
  --out-file ${NEW} ${LIBRARY} RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "abidw failed with ${failed}")
endif()
if(UPDATE)
  file(COPY ${NEW} DESTINATION ${FOLDER})
  message(STATUS "new baseline ${FOLDER}/mvs.abi")
  return()
endif()
execute_process(COMMAND ${ABIDIFF} --no-added-syms
  ${FOLDER}/mvs.abi ${NEW} RESULT_VARIABLE changed OUTPUT_VARIABLE report)
if(changed)
  message(FATAL_ERROR "the binary interface changed:\n${report}")
endif()
message(STATUS "types as in the baseline")
