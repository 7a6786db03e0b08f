// Neighbours in space become neighbours in memory, and the mesh stays the same.

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "libfsi/mesh/numbering.hpp"
#include "tests/unit/mesh/block.hpp"

namespace fsi::test {
namespace {

/// Every rank: the cells of a block as a file has them.
CellList cells_of(const Block& block, const std::vector<std::string>& periodic = {}) {
  const TextFile file(BlockText(block).text());
  return check_mesh(read_gmsh(file.path()), periodic);
}

/// The cells in any order, as mesh generators for tetrahedra leave them.
CellList shuffled(const CellList& list) {
  std::vector<Index> from(list.types.size());
  std::iota(from.begin(), from.end(), 0);
  std::ranges::shuffle(from, std::mt19937(1));
  CellList mixed = list;
  mixed.corners = {};
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto corners = list.corners[from[i]];
    mixed.types[i] = list.types[from[i]], mixed.face_patch[i] = list.face_patch[from[i]];
    mixed.corners.index.insert(mixed.corners.index.end(), corners.begin(), corners.end());
    mixed.corners.offset.push_back(static_cast<Index>(mixed.corners.index.size()));
  }
  return mixed;
}

double lines_of(const CellList& list) {
  std::vector<Index> same(list.types.size());
  std::iota(same.begin(), same.end(), 0);
  return lines_per_cell(cells_across(list, match_faces(list)), same);
}

/// The cells as a mesh.
Mesh built(CellList list) {
  list.point_id.resize(list.points.size());
  std::iota(list.point_id.begin(), list.point_id.end(), 0);
  list.vertex_id = list.vertex;
  return build_mesh(std::move(list));
}

/// What does not depend on the numbers: volumes, places of cells and faces, sizes of patches.
std::vector<Real> figures_of(const CellList& list) {
  const Mesh mesh = built(list);
  std::vector<std::array<Real, 4>> cells, faces;
  for (Index c = 0; c < mesh.n_cells; ++c)
    cells.push_back({mesh.C[c].x, mesh.C[c].y, mesh.C[c].z, mesh.V[c]});
  for (Index f = 0; f < mesh.n_faces; ++f)
    faces.push_back({mesh.Cf[f].x, mesh.Cf[f].y, mesh.Cf[f].z, norm(mesh.Sf[f])});
  std::vector<Real> figures;
  for (const Patch& patch : mesh.patches) figures.push_back(patch.end - patch.begin);
  for (auto* all : {&cells, &faces}) {
    for (auto& row : *all)
      for (Real& x : row) x = std::round(x * 1e9) / 1e9;
    std::ranges::sort(*all);
    for (const auto& row : *all) figures.insert(figures.end(), row.begin(), row.end());
  }
  return figures;
}

TEST(Numbering, ShuffledTetrahedraStandBesideTheirNeighbours) {
  Block block = block_of(CellType::tet);
  block.n = {12, 12, 12};
  CellList list = shuffled(cells_of(block));
  const auto before = figures_of(list);
  EXPECT_GT(lines_of(list), 3);
  EXPECT_TRUE(number_for_memory(list, match_faces(list)));
  EXPECT_LT(lines_of(list), 0.8);
  EXPECT_EQ(figures_of(list), before);
}

TEST(Numbering, APeriodStaysJoined) {
  Block block = block_of(CellType::hex, 3);
  block.n = {14, 13, 12};
  const CellList ordered = cells_of(block, {"left", "right", "bottom", "top", "back", "front"});
  CellList list = shuffled(ordered);
  EXPECT_TRUE(number_for_memory(list, match_faces(list)));
  const Mesh mesh = built(list);
  EXPECT_EQ(mesh.n_boundary(), 0);
  EXPECT_EQ(mesh.n_internal, 3 * 14 * 13 * 12);
}

// The file of 6 tets a cube goes along x first, so that neighbours along z are 30 x 17 cubes apart.
TEST(Numbering, TheReaderNumbersAnew) {
  Block block = block_of(CellType::tet, 1);
  block.n = {30, 17, 5};
  const TextFile file(BlockText(block).text());
  const CellList list = check_mesh(read_gmsh(file.path()), {"left", "right"});
  EXPECT_LT(lines_of(list), 0.4);  // 0.56 in the order of the file
  const Mesh mesh = divided(file.path(), {"left", "right"});
  const Mesh one = built(list);
  EXPECT_EQ(mesh.n_global, 30 * 17 * 5 * 6);
  EXPECT_EQ(mesh.hash, one.hash);
  for (Index c = 0; c < mesh.n_cells; ++c) {
    ASSERT_EQ(mesh.C[c], one.C[static_cast<Index>(mesh.global_id[c])]);
    ASSERT_EQ(mesh.V[c], one.V[static_cast<Index>(mesh.global_id[c])]);
  }
}

// Planes of 32 x 32 cells do not drive each other out of the cache, as they would by their address.
TEST(Numbering, NoCountOfCellsIsSpecial) {
  std::vector<double> lines;
  for (const int n : {31, 32, 33}) {
    std::vector<Index> same(static_cast<std::size_t>(n) * n * n);
    std::iota(same.begin(), same.end(), 0);
    Csr across;
    const auto add = [&](bool there, Index c) {
      if (there) across.index.push_back(c);
    };
    for (const Index c : same) {
      const Index i = c % n, j = c / n % n, k = c / n / n;
      add(k > 0, c - n * n), add(j > 0, c - n), add(i > 0, c - 1);
      add(i + 1 < n, c + 1), add(j + 1 < n, c + n), add(k + 1 < n, c + n * n);
      across.offset.push_back(static_cast<Index>(across.index.size()));
    }
    lines.push_back(lines_per_cell(across, same));
  }
  EXPECT_NEAR(lines[1], lines[0], 0.05);
  EXPECT_NEAR(lines[1], lines[2], 0.05);
}

TEST(Numbering, AnOrderThatNeedsNoMoreLinesStays) {
  Block block = block_of(CellType::quad);
  block.n = {300, 20, 1};
  CellList list = cells_of(block);
  CellList same = list;
  ASSERT_FALSE(number_for_memory(same, match_faces(same)));
  EXPECT_EQ(same.corners.index, list.corners.index);
}

}  // namespace
}  // namespace fsi::test
