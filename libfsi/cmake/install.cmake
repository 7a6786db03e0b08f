# fsi::fsi for find_package(fsi) from outside.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/fsi)
install(TARGETS fsi EXPORT fsiTargets)
install(EXPORT fsiTargets NAMESPACE fsi:: DESTINATION ${config_folder})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/libfsi DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN *.hpp PATTERN cmake EXCLUDE)
if(FSI_DRIVERS)
  list(TRANSFORM FSI_DRIVERS PREPEND fsi- OUTPUT_VARIABLE programs)
  install(TARGETS ${programs})
  install(PROGRAMS ${PROJECT_SOURCE_DIR}/drivers/mpiexec.sh DESTINATION ${CMAKE_INSTALL_BINDIR} RENAME fsi-mpiexec)
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/fsiConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/fsiConfig.cmake
                              INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/fsiConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/fsiConfig.cmake ${PROJECT_BINARY_DIR}/fsiConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/dependencies.cmake
        DESTINATION ${config_folder})
