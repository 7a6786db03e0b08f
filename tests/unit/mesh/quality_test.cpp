// Figures of cells that are known exactly, and passages that are as wide as they are.

#include "libfsi/mesh/quality.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "libfsi/core/error.hpp"
#include "libfsi/mesh/gap.hpp"
#include "tests/unit/mesh/block.hpp"

namespace fsi::test {
namespace {

Mesh mesh_of(const Block& block, const std::vector<std::string>& periodic = {}) {
  const TextFile file(BlockText(block).text());
  return divided(file.path(), periodic);
}

Real ratio_of(CellType type, const std::vector<Vec3>& corners) {
  return aspect_ratio(type, corners);
}

TEST(AspectRatio, IsOneOfCellsWithEqualEdges) {
  const Real h = std::sqrt(0.75);  // height of the triangle
  EXPECT_NEAR(ratio_of(CellType::triangle, {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}}), 1, 1e-14);
  EXPECT_NEAR(ratio_of(CellType::quad, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), 1, 1e-14);
  EXPECT_NEAR(ratio_of(CellType::tet, {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}), 1,
              1e-14);
  EXPECT_NEAR(ratio_of(CellType::prism,
                       {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0, 0, 1}, {1, 0, 1}, {0.5, h, 1}}),
              1, 1e-14);
  EXPECT_NEAR(ratio_of(CellType::pyramid,
                       {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, std::sqrt(0.5)}}),
              1, 1e-14);
}

std::vector<Vec3> brick(Real a, Real b, Real c, Real shear) {
  std::vector<Vec3> x;
  for (const Real z : {Real{0}, c})
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      x.push_back({a * i + shear * z, b * j, z});
  return x;
}

TEST(AspectRatio, OfABrickIsThatOfItsSides) {
  EXPECT_NEAR(ratio_of(CellType::hex, brick(10, 1, 1, 0)), 10, 1e-13);
  EXPECT_NEAR(ratio_of(CellType::hex, brick(3, 2, 0.5, 0)), 6, 1e-13);
}

TEST(AspectRatio, OfAShearedHex) {
  // A cube whose top is moved by its side: edges of sqrt(2), sqrt(1/2) across the slanting sides.
  EXPECT_NEAR(ratio_of(CellType::hex, brick(1, 1, 1, 1)), 2, 1e-14);
}

TEST(AspectRatio, OfASliver) {
  // The corners of a unit square, alternately raised by e: four equal faces of area
  // sqrt(1 + 2 e^2) / 2, volume e / 3, longest edge sqrt(2).
  for (const Real e : {0.5, 0.1, 1e-3, 1e-6}) {
    const Real height = 2 * e / std::sqrt(1 + 2 * e * e);
    const Real expected = std::sqrt(2.0) / height / std::sqrt(1.5);
    EXPECT_NEAR(ratio_of(CellType::tet, {{0, 0, 0}, {1, 0, e}, {1, 1, 0}, {0, 1, e}}) / expected, 1,
                1e-9);
  }
}

TEST(Quality, OfTwoQuadsOfDifferentSize) {
  // The unit square beside the trapezoid (1, 0) (2, 0) (2, 3) (1, 1): area 2, centroid
  // (19, 13) / 12; so d = (13, 7) / 12, and PN crosses x = 1 at 7 / 26 above the face's middle.
  Block block;
  block.type = CellType::quad, block.n = {2, 1, 1};
  block.moved = [](const Vec3& x) { return Vec3{2 * x.x, x.x > 0.9 ? 3 * x.y : x.y, 0}; };
  const Mesh mesh = mesh_of(block);
  const Quality q = quality(mesh);
  const Real length = std::sqrt(218.0) / 12;
  EXPECT_NEAR(q.skewness.value, 7.0 / 26 / length, 1e-14);
  EXPECT_NEAR(q.non_orthogonality.value, std::atan(7.0 / 13) * 180 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(q.non_orthogonality_mean, q.non_orthogonality.value, 1e-12);
  EXPECT_NEAR(q.volume_ratio.value, 2, 1e-14);
  EXPECT_EQ(q.volume_ratio.cell, 0) << "of equal ones the first";
  EXPECT_EQ(q.volume_ratio.type, CellType::quad);
  // The trapezoid's longest edge is 3, its thickness 1, from x = 1 to 2.
  EXPECT_NEAR(q.aspect_ratio.value, 3, 1e-14);
  EXPECT_EQ(q.aspect_ratio.cell, 1);
  EXPECT_NEAR(q.aspect_ratio.x.x, 19.0 / 12, 1e-14);
  EXPECT_NEAR(q.aspect_ratio.x.y, 13.0 / 12, 1e-14);
}

TEST(Quality, OfBrokenCubes) {
  // Six tets about the diagonal: edges 1 to sqrt(3), the least height is sqrt(1/2).
  Block block;
  block.type = CellType::tet, block.n = {3, 3, 3};
  const Quality q = quality(mesh_of(block));
  EXPECT_NEAR(q.aspect_ratio.value, std::sqrt(6.0) / std::sqrt(1.5), 1e-12);
  EXPECT_NEAR(q.volume_ratio.value, 1, 1e-12);
}

TEST(Quality, TheWorstAreListedFromAllRanks) {
  Block block;
  block.n = {3, 4, 2};
  const Mesh mesh = mesh_of(block);
  std::vector<Real> values;
  for (Index c = 0; c < mesh.n_owned; ++c)
    values.push_back(static_cast<Real>(mesh.global_id[c] * 5 % 24));
  const std::vector<Worst> list = worst(values, mesh, 30);
  ASSERT_EQ(list.size(), 24u);
  for (std::size_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(list[i].value, static_cast<Real>(23 - i));
    EXPECT_EQ(list[i].cell * 5 % 24, static_cast<GlobalIndex>(23 - i));
    EXPECT_EQ(value_at(values, list[i].cell, mesh), list[i].value);
  }
  EXPECT_EQ(worst(values, mesh, 3).size(), 3u);
}

TEST(Gap, OfABlockIsItsCountOfBricks) {
  Block block;
  block.n = {4, 5, 3};
  const Gap least = narrowest_gap(mesh_of(block));
  EXPECT_NEAR(least.cells, 3, 1e-12);
  EXPECT_NEAR(least.width, 1, 1e-12);
  EXPECT_NEAR(least.x.z, 0.5, 1e-12);
  EXPECT_TRUE((least.from == "back" && least.to == "front") ||
              (least.from == "front" && least.to == "back"));
  const Gap across = narrowest_gap(mesh_of(block), {"left", "right", "top"});
  EXPECT_NEAR(across.cells, 4, 1e-12);
  EXPECT_THROW(narrowest_gap(mesh_of(block), {"letf"}), Error);
}

TEST(Gap, AnEdgeIsThatOfTheRegularCell) {
  const auto edge_of = [](CellType type, Real volume) {
    Block block;
    block.type = type, block.n = {2, 2, 2};
    const Mesh mesh = mesh_of(block);
    EXPECT_NEAR(mesh.V[0], volume, 1e-12) << name_of(type);
    return edge(mesh, 0);
  };
  EXPECT_NEAR(edge_of(CellType::hex, 0.125), 0.5, 1e-12);
  EXPECT_NEAR(edge_of(CellType::quad, 0.25), 0.5, 1e-12);
  const Real tet = edge_of(CellType::tet, 0.125 / 6), triangle = edge_of(CellType::triangle, 0.125),
             prism = edge_of(CellType::prism, 0.0625),
             pyramid = edge_of(CellType::pyramid, 0.125 / 6);
  EXPECT_NEAR(tet * tet * tet / (6 * std::sqrt(2.0)), 0.125 / 6, 1e-12);
  EXPECT_NEAR(std::sqrt(3.0) / 4 * triangle * triangle, 0.125, 1e-12);
  EXPECT_NEAR(std::sqrt(3.0) / 4 * prism * prism * prism, 0.0625, 1e-12);
  EXPECT_NEAR(pyramid * pyramid * pyramid / (3 * std::sqrt(2.0)), 0.125 / 6, 1e-12);
}

TEST(Gap, CountsTetrahedraByTheirEdge) {
  Block block;
  block.type = CellType::tet, block.n = {3, 4, 5};
  const Mesh mesh = mesh_of(block);
  const Gap gap = narrowest_gap(mesh, {"left", "right"});
  EXPECT_NEAR(gap.width, 1, 1e-12);
  EXPECT_NEAR(gap.cells, 1 / edge(mesh, 0), 1e-9) << "all cells are of one size";
}

TEST(Gap, CountsStretchedAndShearedCells) {
  Block block;
  block.n = {4, 5, 7};
  block.moved = [](const Vec3& x) { return Vec3{10 * x.x, x.y + x.z, x.z}; };
  const Mesh mesh = mesh_of(block);
  const Gap along = narrowest_gap(mesh, {"left", "right"});
  EXPECT_NEAR(along.cells, 4, 1e-12);
  EXPECT_NEAR(along.width, 10, 1e-12);
  // Along z the lines go through the sheared cells' slanting sides, 7 layers all the same; those
  // that begin in the lower half of the slope end at a side.
  block.moved = [](const Vec3& x) { return Vec3{x.x, x.y + 0.4 * x.z, x.z}; };
  EXPECT_NEAR(narrowest_gap(mesh_of(block), {"back", "front"}).cells, 7, 1e-12);
}

TEST(Gap, GoesOnAcrossAPeriod) {
  Block block;
  block.n = {4, 5, 6};
  block.moved = [](const Vec3& x) { return Vec3{x.x, x.y + 0.8 * x.z, x.z}; };
  EXPECT_NEAR(narrowest_gap(mesh_of(block, {"bottom", "top"}), {"back", "front"}).cells, 6, 1e-12);
  block.n = {3, 3, 3}, block.links = 3, block.moved = [](const Vec3& x) { return x; };
  EXPECT_EQ(narrowest_gap(mesh_of(block)).cells, 0) << "no walls";
}

TEST(Gap, GoesBackFromAPlaneOfSymmetry) {
  Block block;
  block.n = {4, 5, 3};
  const Mesh mesh = mesh_of(block);
  const Gap twice = narrowest_gap(mesh, {"left"}, {"right"});
  EXPECT_NEAR(twice.cells, 8, 1e-12);
  EXPECT_NEAR(twice.width, 2, 1e-12);
  EXPECT_NEAR(twice.x.x, 1, 1e-12) << "where it meets the plane";
  EXPECT_EQ(twice.from + twice.to, "leftleft");
  EXPECT_NEAR(narrowest_gap(mesh, {}, {"back"}).cells, 4, 1e-12) << "6 from front to front";
  EXPECT_EQ(narrowest_gap(mesh, {}, {"left", "right", "bottom", "top", "back", "front"}).cells, 0);
}

TEST(Gap, OfTheHalfIsThatOfTheWhole) {
  // Walls at 15 degrees to the plane of symmetry: across it the lines end on the mirrored wall.
  Block block;
  block.type = CellType::quad, block.n = {12, 6, 1};
  block.moved = [](const Vec3& x) {
    return Vec3{4 * x.x, x.y * (1 + std::tan(M_PI / 12) * 4 * x.x), 0};
  };
  const Gap half = narrowest_gap(mesh_of(block), {"top"}, {"bottom"});
  block.n[1] = 12, block.moved = [](const Vec3& x) {
    return Vec3{4 * x.x, (2 * x.y - 1) * (1 + std::tan(M_PI / 12) * 4 * x.x), 0};
  };
  const Gap whole = narrowest_gap(mesh_of(block), {"bottom", "top"});
  EXPECT_GT(whole.cells, 8);
  EXPECT_NEAR(half.cells, whole.cells, 1e-9);
  EXPECT_NEAR(half.width, whole.width, 1e-9);
}

TEST(Gap, OfQuadsInThePlane) {
  Block block;
  block.type = CellType::quad, block.n = {9, 4, 1};
  const Gap gap = narrowest_gap(mesh_of(block));
  EXPECT_NEAR(gap.cells, 4, 1e-12);
  EXPECT_NEAR(gap.x.y, 0.5, 1e-12);
}

}  // namespace
}  // namespace fsi::test
