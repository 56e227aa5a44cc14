# Files that `cmake --install` installs, and their folders: the library, its headers, mvsConfig.cmake and mvs.pc.
include(CMakePackageConfigHelpers)

install(TARGETS mvs EXPORT mvsTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT mvs_runtime
    NAMELINK_COMPONENT mvs_development
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT mvs_development
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mvs_runtime)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/mvs DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT mvs_development FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
install(FILES ${PROJECT_SOURCE_DIR}/include/mvs-api.json
  DESTINATION ${CMAKE_INSTALL_DATADIR}/mvs COMPONENT mvs_development)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR}
  COMPONENT mvs_runtime)
# documents and examples for C programmers and authors of drivers
# The installed README keeps its links to installed files; of those to the source tree the text stays.
file(READ ${PROJECT_SOURCE_DIR}/README.md readme)
string(REGEX REPLACE "!\\[[^]]*\\]\\([^)]*\\)\n+" "" readme "${readme}")
string(REGEX REPLACE
  "\\]\\((formats|libmvs/surgery|libmvs/measure|libmvs/anatomy)/(FORMAT|OPERATIONS|DEFINITIONS|PARAMETRIC)\\.md"
  "](\\2.md" readme "${readme}")
string(REGEX REPLACE
  "\\[([^]]*)\\]\\((libmvs|include|bindings|tests|formats|examples/planner|examples/pictures|CONTRIBUTING)[^)]*\\)"
  "\\1" readme "${readme}")
file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/installed/README.md CONTENT "${readme}")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/README.md)
install(FILES ${PROJECT_BINARY_DIR}/installed/README.md CHANGELOG.md formats/FORMAT.md libmvs/surgery/OPERATIONS.md
  libmvs/measure/DEFINITIONS.md libmvs/anatomy/PARAMETRIC.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT mvs_development)
install(FILES examples/hello.c examples/close.c examples/repair.c
  DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples COMPONENT mvs_development)
install(DIRECTORY examples/plans DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples
  COMPONENT mvs_development)
install(FILES haptic_drivers/README.md haptic_drivers/template/template.c
  haptic_drivers/mouse/pointer.h
  DESTINATION ${CMAKE_INSTALL_DOCDIR}/haptic_drivers COMPONENT mvs_development)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/mvs)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/mvsConfig.cmake.in
  ${PROJECT_BINARY_DIR}/mvsConfig.cmake INSTALL_DESTINATION ${package_dir})
# While 0.x a minor version may break, so it must be the one asked for.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/mvsConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(EXPORT mvsTargets NAMESPACE mvs:: DESTINATION ${package_dir} COMPONENT mvs_development)
install(FILES ${PROJECT_BINARY_DIR}/mvsConfig.cmake ${PROJECT_BINARY_DIR}/mvsConfigVersion.cmake
  DESTINATION ${package_dir} COMPONENT mvs_development)

# Absolute or relative, as GNUInstallDirs allows both.
foreach(dir LIBDIR INCLUDEDIR)
  if(IS_ABSOLUTE "${CMAKE_INSTALL_${dir}}")
    set(pc_${dir} "${CMAKE_INSTALL_${dir}}")
  else()
    set(pc_${dir} "\${prefix}/${CMAKE_INSTALL_${dir}}")
  endif()
endforeach()
# A package can be moved: the prefix is found from the place of mvs.pc itself.
file(RELATIVE_PATH pc_up "/p/${CMAKE_INSTALL_LIBDIR}/pkgconfig" /p)
string(REGEX REPLACE "/$" "" pc_up "${pc_up}")
configure_file(${CMAKE_CURRENT_LIST_DIR}/mvs.pc.in ${PROJECT_BINARY_DIR}/mvs.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/mvs.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
  COMPONENT mvs_development)
