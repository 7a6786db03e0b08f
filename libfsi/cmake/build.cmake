# What only building the library needs: HDF5, which is found by C. Who links the library gets its files by
# their paths.
set(HDF5_PREFER_PARALLEL ON)
find_package(HDF5 REQUIRED COMPONENTS C)
