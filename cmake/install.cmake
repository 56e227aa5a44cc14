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

# The folder of documents: that of this project, also inside another one.
if(PROJECT_IS_TOP_LEVEL)
  set(mvs_docs ${CMAKE_INSTALL_DOCDIR})
else()
  set(mvs_docs ${CMAKE_INSTALL_DATAROOTDIR}/doc/${PROJECT_NAME})
endif()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${mvs_docs} COMPONENT mvs_runtime)
# Licences of what is compiled into the binaries, where the system has their texts.
foreach(package libeigen3-dev nlohmann-json3-dev libcli11-dev)
  if(EXISTS /usr/share/doc/${package}/copyright)
    install(FILES /usr/share/doc/${package}/copyright DESTINATION ${mvs_docs}/licences
      RENAME ${package}.txt COMPONENT mvs_runtime)
  endif()
endforeach()
# documents and examples for C programmers and authors of drivers
include(installed_documents)
mvs_for_pairs(mvs_install_document ${mvs_installed_documents})
mvs_for_pairs(mvs_install_beside ${mvs_installed_files})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/plans DESTINATION ${mvs_docs}/examples
  COMPONENT mvs_development PATTERN README.md EXCLUDE)

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
# A package can be moved: the prefix is found from the place of mvs.pc itself, where that is below it.
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
  set(pc_prefix ${CMAKE_INSTALL_PREFIX})
else()
  file(RELATIVE_PATH pc_up "/p/${CMAKE_INSTALL_LIBDIR}/pkgconfig" /p)
  string(REGEX REPLACE "/$" "" pc_up "${pc_up}")
  set(pc_prefix "\${pcfiledir}/${pc_up}")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/mvs.pc.in ${PROJECT_BINARY_DIR}/mvs.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/mvs.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
  COMPONENT mvs_development)
