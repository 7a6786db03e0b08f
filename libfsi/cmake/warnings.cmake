# Flags of our own targets, never passed on to who links the library.
add_library(fsi_flags INTERFACE)
target_compile_options(fsi_flags INTERFACE -Wall -Wextra -Wshadow -Wpedantic -Werror)
# No fused multiply-add contraction: a face seen from two ranks gives the same bits on both.
target_compile_options(fsi_flags INTERFACE -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(FSI_SANITIZE)
  target_compile_options(fsi_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer -O1)
  target_link_options(fsi_flags INTERFACE -fsanitize=address,undefined)
  # Not of the library: where sources are joined, both would define the same function.
  target_sources(fsi_flags INTERFACE
    "$<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:${PROJECT_SOURCE_DIR}/tests/sanitize/keep_loaded.cpp>")
endif()
