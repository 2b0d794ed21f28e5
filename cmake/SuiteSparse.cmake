# Defines polyaffine::suitesparse: CHOLMOD, UMFPACK and the OpenMP runtime that CHOLMOD uses, found on this machine.
# Sets polyaffine_suitesparse_FOUND. Used by the build and, installed, by find_package(polyaffine COMPONENTS sparse).
find_path(POLYAFFINE_CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(POLYAFFINE_CHOLMOD_LIBRARY cholmod)
find_library(POLYAFFINE_UMFPACK_LIBRARY umfpack)
find_library(POLYAFFINE_GOMP_LIBRARY NAMES gomp libgomp.so.1)
mark_as_advanced(POLYAFFINE_CHOLMOD_INCLUDE_DIR POLYAFFINE_CHOLMOD_LIBRARY POLYAFFINE_UMFPACK_LIBRARY POLYAFFINE_GOMP_LIBRARY)

if(POLYAFFINE_CHOLMOD_INCLUDE_DIR AND POLYAFFINE_CHOLMOD_LIBRARY AND POLYAFFINE_UMFPACK_LIBRARY AND POLYAFFINE_GOMP_LIBRARY)
  set(polyaffine_suitesparse_FOUND YES)
  if(NOT TARGET polyaffine::suitesparse)
    add_library(polyaffine::suitesparse INTERFACE IMPORTED)
    target_include_directories(polyaffine::suitesparse SYSTEM INTERFACE ${POLYAFFINE_CHOLMOD_INCLUDE_DIR})
    target_link_libraries(polyaffine::suitesparse INTERFACE
      ${POLYAFFINE_CHOLMOD_LIBRARY} ${POLYAFFINE_UMFPACK_LIBRARY} ${POLYAFFINE_GOMP_LIBRARY})
  endif()
else()
  set(polyaffine_suitesparse_FOUND NO)
endif()
