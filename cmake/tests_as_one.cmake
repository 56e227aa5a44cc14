# mvs_tests_as_one(OUT COUNT SOURCE ...): files of tests of one room that are compiled as one, COUNT at a time.
#
# Tests use the same names in many files, so that CMake's unity build cannot join them. Here each file
# stands in a namespace of its own: the headers of all come first, at file scope, and their include
# guards make the same lines empty inside. The namespace mvs::core::test of a file becomes one of its
# own that sees the common one. OUT receives the joined files and those that stay apart: helpers
# without a test, other namespaces, conditional code, macros, replaced operators.
function(mvs_tests_as_one out count)
  set(result "")
  set(batch "")
  set(room "")
  foreach(source ${ARGN})
    # helpers of two rooms may use the same names
    file(RELATIVE_PATH path ${CMAKE_CURRENT_SOURCE_DIR} ${source})
    string(REGEX REPLACE "/.*" "" room_of_source ${path})
    if(batch AND NOT room_of_source STREQUAL room)
      mvs_join_tests(result ${batch})
      set(batch "")
    endif()
    set(room ${room_of_source})
    file(STRINGS ${source} cases REGEX "^TEST_CASE" LIMIT_COUNT 1)
    file(STRINGS ${source} apart LIMIT_COUNT 1
      REGEX "^ *# *(if|define)|^#include .*[.]def\"|operator new|^extern|^namespace (std|bench|hd|mvs|mvs::core) ")
    if(cases AND NOT apart)
      list(APPEND batch ${source})
      list(LENGTH batch filled)
      if(filled EQUAL count)
        mvs_join_tests(result ${batch})
        set(batch "")
      endif()
    else()
      list(APPEND result ${source})
    endif()
  endforeach()
  if(batch)
    mvs_join_tests(result ${batch})
  endif()
  set(${out} ${result} PARENT_SCOPE)
endfunction()

# mvs_join_tests(OUT SOURCE ...): appends one file that holds these to the list OUT.
function(mvs_join_tests out)
  set(headers "")
  set(bodies "")
  set(number 0)
  foreach(source ${ARGN})
    file(STRINGS ${source} lines REGEX "^#include")
    list(APPEND headers ${lines})
    file(STRINGS ${source} own REGEX "^namespace mvs::core::test {" LIMIT_COUNT 1)
    math(EXPR number "${number} + 1")
    if(own)
      string(APPEND bodies "namespace mvs::core::test {}\n"
        "namespace mvs::core::test_${number} {\nusing namespace test;\n}\n"
        "#define test test_${number}\n#include \"${source}\"\n#undef test\n")
    else()
      string(APPEND bodies "namespace tests_${number} {\n#include \"${source}\"\n}\n")
    endif()
  endforeach()
  list(REMOVE_DUPLICATES headers)
  list(JOIN headers "\n" headers)
  list(LENGTH ${out} index)
  set(file ${CMAKE_CURRENT_BINARY_DIR}/tests_as_one_${index}.cpp)
  file(CONFIGURE OUTPUT ${file} CONTENT "${headers}\n${bodies}" @ONLY)
  # a file that changes its headers changes the joined file
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ARGN})
  set(${out} ${${out}} ${file} PARENT_SCOPE)
endfunction()
