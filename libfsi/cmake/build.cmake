# What only building the library needs: HDF5, which is found by C, and libyaml, which PETSc needs too. Who
# links the library gets their files by their paths.
set(HDF5_PREFER_PARALLEL ON)
find_package(HDF5 REQUIRED COMPONENTS C)
find_library(YAML_LIBRARY yaml REQUIRED)
find_path(YAML_INCLUDE_DIR yaml.h REQUIRED)
