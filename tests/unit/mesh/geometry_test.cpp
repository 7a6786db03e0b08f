// Areas, volumes, centroids and neighbours of blocks that are known exactly.

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/mesh/block.hpp"
#include "tests/unit/support/box_mesh.hpp"

namespace fsi::test {
namespace {

Mesh block_mesh(const Block& block, const std::vector<std::string>& periodic) {
  const TextFile file(BlockText(block).text());
  return divided(file.path(), periodic);
}

std::vector<std::string> all_sides(int dim) {
  std::vector<std::string> names{"left", "right", "bottom", "top", "back", "front"};
  names.resize(static_cast<std::size_t>(2 * dim));
  return names;
}

TEST(Geometry, EveryCellClosesAndVolumesAddUp) {
  for (const CellType type : all_types) {
    for (const int links : {0, shape_of(type).dim}) {
      for (const bool named : {false, true}) {
        Block block;
        block.type = type, block.links = links, block.n = {3, 4, 3};
        block.moved = block.dim() == 2 ? warp_plane : warp;
        const bool periodic = named || links > 0;
        const Mesh mesh =
            block_mesh(block, named ? all_sides(block.dim()) : std::vector<std::string>{});
        EXPECT_LE(quality(mesh).closure_max, 1e-14);
        EXPECT_EQ(mesh.n_boundary() == 0, periodic || mesh.n_owned == 0);
        // A block of period 1 in every direction fills the unit cube, however it is warped.
        if (periodic) {
          EXPECT_NEAR(mesh.total_volume, 1, 1e-13);
        }
      }
    }
  }
}

TEST(Geometry, VolumeIsTheFluxOfPosition) {
  // [Gauss] V = sum_f x . Sf / dim, exact for plane faces about their centroids
  for (const CellType type : {CellType::triangle, CellType::quad, CellType::tet}) {
    Block block;
    block.type = type, block.moved = block.dim() == 2 ? warp_plane : warp;
    const Mesh mesh = block_mesh(block, {"left", "right"});
    for (Index c = 0; c < mesh.n_owned; ++c) {
      Real flux = 0;
      for (const Index f : mesh.cell_faces[c]) {
        const Real sign = mesh.owner[f] == c ? 1 : -1;
        flux += sign * dot(mesh.face_centre(f, c) - mesh.C[c], mesh.Sf[f]);
      }
      EXPECT_NEAR(flux / mesh.dim, mesh.V[c], 1e-15);
    }
  }
}

TEST(Geometry, FacesPointFromOwnerToNeighbour) {
  for (const CellType type : all_types) {
    Block block;
    block.type = type;
    const Mesh mesh = block_mesh(block, all_sides(block.dim()));
    const Real reach = std::sqrt(block.dim()) / 3;  // no cell is farther from its neighbour
    for (Index f = 0; f < mesh.n_internal; ++f) {
      const Index P = mesh.owner[f], N = mesh.neighbour[f];
      EXPECT_LT(mesh.global_id[P], mesh.global_id[N]);
      EXPECT_GT(dot(mesh.d[f], mesh.Sf[f]), 0);
      EXPECT_LT(norm(mesh.d[f]), reach);
      EXPECT_LT(norm(mesh.face_centre(f, P) - mesh.C[P]), reach);
      EXPECT_LT(norm(mesh.face_centre(f, N) - mesh.C[N]), reach);
      EXPECT_LT(norm(mesh.corner(f, 1, N) - mesh.C[N]), reach);
      EXPECT_LT(norm(mesh.C[N] + mesh.translation[mesh.shift[f]] - mesh.C[P] - mesh.d[f]), 1e-15);
    }
  }
}

TEST(Geometry, CornersAreRightHandedAboutSf) {
  for (const CellType type : all_types) {
    Block block;
    block.type = type;
    const Mesh mesh = block_mesh(block, {});
    for (Index f = 0; f < mesh.n_faces; ++f) {
      const auto points = mesh.face_points[f];
      const Vec3 a = mesh.points[points[0]], b = mesh.points[points[1]];
      if (mesh.dim == 2) {
        ASSERT_EQ(points.size(), 2u);
        EXPECT_NEAR(dot(b - a, mesh.Sf[f]), 0, 1e-15);
        EXPECT_NEAR(norm(b - a), norm(mesh.Sf[f]), 1e-15);
        continue;
      }
      EXPECT_GT(dot(cross(b - a, mesh.points[points[2]] - a), mesh.Sf[f]), 0);
    }
  }
}

TEST(Geometry, CentroidsOfKnownCells) {
  const std::vector<Vec3> tet{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_NEAR(cell_metrics(CellType::tet, tet).V, 1.0 / 6, 1e-16);
  EXPECT_LT(norm(cell_metrics(CellType::tet, tet).centre - Vec3{0.25, 0.25, 0.25}), 1e-15);
  const std::vector<Vec3> pyramid{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 3}};
  EXPECT_NEAR(cell_metrics(CellType::pyramid, pyramid).V, 4, 1e-14);
  EXPECT_LT(norm(cell_metrics(CellType::pyramid, pyramid).centre - Vec3{1, 1, 0.75}), 1e-15);
  const std::vector<Vec3> prism{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 2}, {3, 0, 2}, {0, 3, 2}};
  EXPECT_NEAR(cell_metrics(CellType::prism, prism).V, 9, 1e-14);
  EXPECT_LT(norm(cell_metrics(CellType::prism, prism).centre - Vec3{1, 1, 1}), 1e-15);
  // A trapezium with parallel sides 2 and 1 at height 1: y = (2 + 2 * 1) / (3 (2 + 1)) = 4/9.
  const std::vector<Vec3> quad{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_NEAR(cell_metrics(CellType::quad, quad).V, 1.5, 1e-15);
  EXPECT_NEAR(cell_metrics(CellType::quad, quad).centre.y, 4.0 / 9, 1e-15);
  const std::vector<Vec3> trapezium{{0, 0, 5}, {2, 0, 5}, {1, 1, 5}, {0, 1, 5}};
  EXPECT_EQ(face_metrics(trapezium).Sf, (Vec3{0, 0, 1.5}));
  EXPECT_NEAR(face_metrics(trapezium).centre.y, 4.0 / 9, 1e-15);
}

TEST(Geometry, SameAsTheStructuredBox) {
  Block block;
  block.n = {4, 3, 5};
  const TextFile file(BlockText(block).text());
  const Mesh mesh = whole(file.path(), {"left", "right", "back", "front"});
  const Mesh box = box_mesh({{4, 3, 5}, {1, 1, 1}, {true, false, true}});
  ASSERT_EQ(mesh.n_faces, box.n_faces);
  ASSERT_EQ(mesh.n_internal, box.n_internal);
  EXPECT_EQ(mesh.owner, box.owner);
  EXPECT_EQ(mesh.neighbour, box.neighbour);
  for (Index f = 0; f < mesh.n_faces; ++f) {
    EXPECT_LT(norm(mesh.Sf[f] - box.Sf[f]), 1e-15);
    EXPECT_LT(norm(mesh.Cf[f] - box.Cf[f]), 1e-15);
    EXPECT_LT(norm(mesh.d[f] - box.d[f]), 1e-15);
  }
  EXPECT_EQ(mesh.cell_faces.index, box.cell_faces.index);
  EXPECT_EQ(mesh.patches.size(), box.patches.size());
  EXPECT_EQ(mesh.patch("top").begin, box.patch("top").begin);
  for (Index c = 0; c < mesh.n_owned; ++c) {
    const auto seen = [c](const Mesh& m) {
      std::multiset<std::tuple<Index, Real, Real, Real>> set;
      for (Index i = m.cell_neighbours.offset[c]; i < m.cell_neighbours.offset[c + 1]; ++i) {
        const Vec3 t = m.translation[m.cell_neighbour_shift[i]];
        set.emplace(m.cell_neighbours.index[i], t.x, t.y, t.z);
      }
      return set;
    };
    EXPECT_EQ(seen(mesh), seen(box));
    EXPECT_LT(norm(mesh.C[c] - box.C[c]), 1e-15);
  }
}

TEST(Geometry, EveryVertexNeighbourIsThere) {
  Block block;
  block.n = {3, 3, 3};
  const Mesh hexes = block_mesh(block, all_sides(3));
  for (Index c = 0; c < hexes.n_owned; ++c) EXPECT_EQ(hexes.cell_neighbours[c].size(), 26u);
  block.type = CellType::quad;
  const Mesh quads = block_mesh(block, all_sides(2));
  for (Index c = 0; c < quads.n_owned; ++c) EXPECT_EQ(quads.cell_neighbours[c].size(), 8u);
}

TEST(Quality, OfAShearedGrid) {
  Block block;
  block.type = CellType::quad, block.n = {6, 6, 1};
  block.moved = [](const Vec3& x) { return Vec3{x.x + x.y, x.y, 0}; };  // 45 degrees
  const Quality q = quality(block_mesh(block, {}));
  EXPECT_NEAR(q.non_orthogonality.value, 45, 1e-10);
  EXPECT_NEAR(q.non_orthogonality_mean, 45, 1e-10);
  EXPECT_NEAR(q.skewness.value, 0, 1e-12);
  EXPECT_NEAR(q.volume_min, 1.0 / 36, 1e-15);
  EXPECT_NEAR(q.volume_max, 1.0 / 36, 1e-15);
}

}  // namespace
}  // namespace fsi::test
