#pragma once
// A structured box of quads or hexes on one rank, built straight into the flat arrays: for tests of
// what works on a Mesh, without a mesh file.

#include <array>
#include <cstdint>
#include <vector>

#include "libfsi/mesh/mesh.hpp"

namespace fsi::test {

/// Cells per axis (n[2] = 0: 2-D), lengths, and which axes are periodic.
struct Box {
  std::array<Index, 3> n{4, 4, 0};
  Vec3 length{1, 1, 1};
  std::array<bool, 3> periodic{false, false, false};
};

/// Patches left, right, bottom, top, back, front in this order, none where periodic.
Mesh box_mesh(const Box& box);

}  // namespace fsi::test
