# Documents are installed side by side: their links lead to installed files, and a link to another file
# of the source tree becomes its text.
set(mvs_installed_documents  # in the source tree, then below the folder of documents
  README.md README.md
  CHANGELOG.md CHANGELOG.md
  formats/FORMAT.md FORMAT.md
  libmvs/surgery/OPERATIONS.md OPERATIONS.md
  libmvs/measure/DEFINITIONS.md DEFINITIONS.md
  libmvs/measure/orifice/METHOD.md METHOD.md
  libmvs/anatomy/PARAMETRIC.md PARAMETRIC.md
  examples/plans/README.md examples/plans/README.md
  haptic_drivers/README.md haptic_drivers/README.md)
set(mvs_installed_files
  examples/hello.c examples/hello.c
  examples/close.c examples/close.c
  examples/repair.c examples/repair.c
  haptic_drivers/template/template.c haptic_drivers/template.c
  haptic_drivers/mouse/pointer.h haptic_drivers/pointer.h)

# Puts into `result` where a file of the source tree is installed, or nothing.
function(mvs_installed_place result file)
  set(pairs LICENSE LICENSE ${mvs_installed_documents} ${mvs_installed_files})
  list(FIND pairs "${file}" at)
  set(place "")
  if(at GREATER -1)
    math(EXPR next "${at} + 1")
    list(GET pairs ${next} place)
  endif()
  set(${result} "${place}" PARENT_SCOPE)
endfunction()

# One link of a document in the source folder `from`, which is installed in the folder `to`.
function(mvs_move_link result text from to link)
  string(REGEX MATCH "#.*$" anchor "${link}")
  string(REGEX REPLACE "#.*$" "" path "${link}")
  get_filename_component(absolute "${PROJECT_SOURCE_DIR}/${from}/${path}" ABSOLUTE)
  file(RELATIVE_PATH file "${PROJECT_SOURCE_DIR}" "${absolute}")
  mvs_installed_place(place "${file}")
  if(place)
    file(RELATIVE_PATH path "/${to}" "/${place}")
    string(REPLACE "](${link})" "](${path}${anchor})" text "${text}")
  else()
    string(REGEX REPLACE "\\[([^]]*)\\]\\(${link}\\)" "\\1" text "${text}")
  endif()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# Installs the document `file` as `place` below the folder of documents.
function(mvs_install_document file place)
  get_filename_component(from "${file}" DIRECTORY)
  get_filename_component(to "${place}" DIRECTORY)
  file(READ ${PROJECT_SOURCE_DIR}/${file} text)
  string(REGEX REPLACE "!\\[[^]]*\\]\\([^)]*\\)\n+" "" text "${text}")  # pictures
  string(REPLACE "](" "@(" links "${text}")  # as a list, elements with a single bracket would be joined
  string(REGEX MATCHALL "@\\([^)# ][^) ]*\\)" links "${links}")
  list(REMOVE_DUPLICATES links)
  foreach(link ${links})
    string(REGEX REPLACE "^@\\((.*)\\)$" "\\1" link "${link}")
    if(NOT link MATCHES "^https?:")
      mvs_move_link(text "${text}" "${from}" "${to}" "${link}")
    endif()
  endforeach()
  file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/installed/${place} CONTENT "${text}")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${file})
  install(FILES ${PROJECT_BINARY_DIR}/installed/${place} DESTINATION ${mvs_docs}/${to}
    COMPONENT mvs_development)
endfunction()

# Calls `function` with each pair of a list.
macro(mvs_for_pairs function)
  set(pairs ${ARGN})
  while(pairs)
    list(POP_FRONT pairs file place)
    cmake_language(CALL ${function} "${file}" "${place}")
  endwhile()
endmacro()

function(mvs_install_beside file place)
  get_filename_component(to "${place}" DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/${file} DESTINATION ${mvs_docs}/${to} COMPONENT mvs_development)
endfunction()
