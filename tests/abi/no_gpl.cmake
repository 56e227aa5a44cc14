# Fails if LIBRARY links a GPL library, directly or through another one; prints the libraries that it links.
file(GET_RUNTIME_DEPENDENCIES LIBRARIES ${LIBRARY} RESOLVED_DEPENDENCIES_VAR found
  UNRESOLVED_DEPENDENCIES_VAR missing)
if(NOT found)
  message(FATAL_ERROR "no_gpl: ${LIBRARY} has no dependencies: they could not be read")
endif()
foreach(library ${found} ${missing})
  get_filename_component(name ${library} NAME)
  if(name MATCHES "^lib(cholmod|umfpack|spqr|klu|fftw3|gsl|readline)[.]")
    message(FATAL_ERROR "no_gpl: the library links ${library}, which is GPL: build with -DMVS_CHOLMOD=OFF")
  endif()
  message("${name}")
endforeach()
