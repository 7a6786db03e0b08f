# fsi::fsi for find_package(fsi) from outside.
