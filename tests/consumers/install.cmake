# Installs a build into an empty folder and checks that it contains every file that a user needs,
# and no other.
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX}
  RESULT_VARIABLE failed OUTPUT_QUIET)
if(failed)
  message(FATAL_ERROR "cmake --install failed")
endif()

file(GLOB shipped RELATIVE ${SOURCE}/include/mvs ${SOURCE}/include/mvs/*)
file(GLOB installed RELATIVE ${PREFIX}/include/mvs ${PREFIX}/include/mvs/*)
if(NOT "${shipped}" STREQUAL "${installed}")
  message(FATAL_ERROR "headers: installed '${installed}', in the repository '${shipped}'")
endif()
# the library under its SONAME, which carries major.minor
foreach(pattern bin/mvs lib*/libmvs.so.${SOVERSION} lib*/cmake/mvs/mvsConfig.cmake
        lib*/pkgconfig/mvs.pc share/doc/libmvs/LICENSE share/doc/libmvs/README.md share/doc/libmvs/FORMAT.md
        share/doc/libmvs/OPERATIONS.md share/doc/libmvs/DEFINITIONS.md share/doc/libmvs/PARAMETRIC.md
        share/doc/libmvs/examples/hello.c share/doc/libmvs/examples/plans/valve1.json
        share/doc/libmvs/haptic_drivers/template.c)
  file(GLOB found ${PREFIX}/${pattern})
  if(NOT found)
    message(FATAL_ERROR "not installed: ${pattern}")
  endif()
endforeach()

# Each link of an installed document leads to an installed file.
file(GLOB_RECURSE documents ${PREFIX}/share/doc/libmvs/*.md)
foreach(document ${documents})
  get_filename_component(folder ${document} DIRECTORY)
  file(READ ${document} text)
  string(REPLACE "](" "@(" text "${text}")  # as a list, elements with a single bracket would be joined
  string(REGEX MATCHALL "@\\([^)# ][^)# ]*" links "${text}")
  foreach(link ${links})
    string(REPLACE "@(" "" link "${link}")
    if(NOT link MATCHES "^https?:" AND NOT EXISTS ${folder}/${link})
      message(FATAL_ERROR "${document} links to ${link}, which is not installed")
    endif()
  endforeach()
endforeach()

# No path of the building machine may occur in installed text files.
file(GLOB_RECURSE texts ${PREFIX}/*.cmake ${PREFIX}/*.pc ${PREFIX}/*.h)
foreach(text ${texts})
  file(READ ${text} content)
  foreach(path ${BUILD} ${SOURCE} ${PREFIX})
    string(FIND "${content}" "${path}" place)
    if(NOT place EQUAL -1)
      message(FATAL_ERROR "${text} holds the path ${path}")
    endif()
  endforeach()
endforeach()

execute_process(COMMAND ${PREFIX}/bin/mvs --version RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "the installed command does not start")
endif()
