# fsi::fsi for find_package(fsi) from outside, fsi.pc for pkg-config, drivers, meshes, examples and the
# Python package that draws. Component programs: what runs a case; development: what builds against the
# library.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/fsi)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
install(TARGETS fsi EXPORT fsiTargets)
install(EXPORT fsiTargets NAMESPACE fsi:: DESTINATION ${config_folder})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/libfsi DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN *.hpp PATTERN cmake EXCLUDE)
if(FSI_DRIVERS)
  list(TRANSFORM FSI_DRIVERS PREPEND fsi- OUTPUT_VARIABLE programs)
  install(TARGETS ${programs} COMPONENT programs)
  install(PROGRAMS ${PROJECT_SOURCE_DIR}/drivers/mpiexec.sh DESTINATION ${CMAKE_INSTALL_BINDIR} RENAME fsi-mpiexec
          COMPONENT programs)
  install(FILES ${FSI_MAN_PAGES} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT programs OPTIONAL)
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/fsiConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/fsiConfig.cmake
                              INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/fsiConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/fsiConfig.cmake ${PROJECT_BINARY_DIR}/fsiConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/dependencies.cmake
        DESTINATION ${config_folder})

# pkg-config: the files of PETSc, MPI, HDF5, libyaml and METIS by their paths, the library by its place beside fsi.pc.
set(pc_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH pc_prefix /prefix/${pc_folder} /prefix)
set(pc_includes ${PETSC_INCLUDE_DIRS} ${MPI_CXX_INCLUDE_DIRS})
list(REMOVE_DUPLICATES pc_includes)
list(TRANSFORM pc_includes PREPEND -I)
list(JOIN pc_includes " " pc_includes)
set(pc_libraries ${PETSC_LINK_LIBRARIES} ${HDF5_C_LIBRARIES} ${YAML_LIBRARY} ${METIS_LIBRARY} ${MPI_CXX_LIBRARIES})
list(REMOVE_DUPLICATES pc_libraries)
list(TRANSFORM pc_libraries REPLACE "^([^/-].*)$" "-l\\1")
list(JOIN pc_libraries " " pc_libraries)
configure_file(${CMAKE_CURRENT_LIST_DIR}/fsi.pc.in ${PROJECT_BINARY_DIR}/fsi.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/fsi.pc DESTINATION ${pc_folder})

# The examples without those that measure the library from its source tree.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME programs)
set(data_folder ${CMAKE_INSTALL_DATADIR}/fsi)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/meshes DESTINATION ${data_folder} FILES_MATCHING PATTERN *.geo)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${data_folder} USE_SOURCE_PERMISSIONS
        PATTERN __pycache__ EXCLUDE PATTERN speed_error EXCLUDE PATTERN stability EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/python DESTINATION ${data_folder} FILES_MATCHING PATTERN *.py)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
