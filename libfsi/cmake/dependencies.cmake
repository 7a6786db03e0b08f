# PETSc (with hypre, MPI and libyaml) and METIS, as who links the library needs them: the installed
# fsiConfig.cmake reads this file too, in projects that may not know C. HDF5 is in build.cmake.
find_package(MPI REQUIRED COMPONENTS CXX)
find_package(PkgConfig REQUIRED)

# Debian keeps PETSc.pc beside the library, out of pkg-config's own path.
file(GLOB petsc_pkgconfig /usr/lib/petscdir/petsc*/*-real/lib/pkgconfig $ENV{PETSC_DIR}/lib/pkgconfig)
foreach(folder IN LISTS petsc_pkgconfig)
  set(ENV{PKG_CONFIG_PATH} "$ENV{PKG_CONFIG_PATH}:${folder}")
endforeach()
if(NOT TARGET PkgConfig::PETSC)
  pkg_check_modules(PETSC REQUIRED IMPORTED_TARGET PETSc>=3.18)
  # The -D_FORTIFY_SOURCE of the packager's flags is not ours to pass on.
  set_property(TARGET PkgConfig::PETSC PROPERTY INTERFACE_COMPILE_OPTIONS "")
endif()

find_library(METIS_LIBRARY metis REQUIRED)
find_path(METIS_INCLUDE_DIR metis.h REQUIRED)
if(NOT TARGET METIS::METIS)
  add_library(METIS::METIS UNKNOWN IMPORTED)
  set_target_properties(METIS::METIS PROPERTIES IMPORTED_LOCATION "${METIS_LIBRARY}"
                                                INTERFACE_INCLUDE_DIRECTORIES "${METIS_INCLUDE_DIR}")
endif()
