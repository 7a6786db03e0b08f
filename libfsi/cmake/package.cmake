# Debian packages, by cpack -G DEB in the build folder: fsi with the programs, libfsi-dev with the library.
set(CPACK_PACKAGE_NAME libfsi)
set(CPACK_PACKAGE_CONTACT "the libfsi authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "soft solids in viscous flow on unstructured meshes")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)
set(CPACK_COMPONENTS_ALL programs development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

# The shared libraries are found by dpkg-shlibdeps. gmsh and Python make meshes and pictures.
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME fsi)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS openmpi-bin)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS "gmsh, python3-numpy, python3-matplotlib, python3-h5py")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libfsi-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "g++, pkg-config, libpetsc-real-dev, libmetis-dev, libhdf5-openmpi-dev, libopenmpi-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "cmake, fsi")
include(CPack)
