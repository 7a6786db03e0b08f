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
  return lines_per_cell(cells_across(list), same);
}

/// What does not depend on the numbers: volumes, places of cells and faces, sizes of patches.
std::vector<Real> figures_of(CellList list) {
  list.point_id.resize(list.points.size());
  std::iota(list.point_id.begin(), list.point_id.end(), 0);
  list.vertex_id = list.vertex;
  const Mesh mesh = build_mesh(std::move(list));
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
  EXPECT_TRUE(number_for_memory(list));
  EXPECT_LT(lines_of(list), 0.8);
  EXPECT_EQ(figures_of(list), before);
}

TEST(Numbering, APeriodStaysJoined) {
  Block block = block_of(CellType::hex, 3);
  block.n = {14, 13, 12};
  const CellList ordered = cells_of(block, {"left", "right", "bottom", "top", "back", "front"});
  CellList list = shuffled(ordered);
  EXPECT_TRUE(number_for_memory(list));
  const Mesh mesh = [&] {
    CellList whole = list;
    whole.point_id.resize(whole.points.size());
    std::iota(whole.point_id.begin(), whole.point_id.end(), 0);
    whole.vertex_id = whole.vertex;
    return build_mesh(std::move(whole));
  }();
  EXPECT_EQ(mesh.n_boundary(), 0);
  EXPECT_EQ(mesh.n_internal, 3 * 14 * 13 * 12);
}

TEST(Numbering, AnOrderThatNeedsNoMoreLinesStays) {
  Block block = block_of(CellType::quad);
  block.n = {300, 20, 1};
  CellList list = cells_of(block);
  CellList same = list;
  ASSERT_FALSE(number_for_memory(same));
  EXPECT_EQ(same.corners.index, list.corners.index);
}

}  // namespace
}  // namespace fsi::test
