#include "libfsi/vof/reconstruct.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "libfsi/core/parallel.hpp"
#include "libfsi/vof/fill.hpp"
#include "tests/unit/support/box_file.hpp"
#include "tests/unit/support/box_mesh.hpp"

namespace fsi::vof {
namespace {

/// Exact fractions of the half space n . (x - x0) < 0.
void fill_half_space(CellField<Real>& alpha, const Mesh& mesh, const Vec3& n, const Vec3& x0) {
  geometry::Polytope cell(mesh.dim);
  for (Index c = 0; c < mesh.n_owned; ++c) {
    gather(cell, mesh, c);
    alpha[c] = geometry::measure_below(cell, {n, dot(n, x0 - mesh.C[c])}) / geometry::measure(cell);
  }
  mesh.halo.update(alpha);
}

/// A smooth map of the unit box to itself that leaves its boundary in place.
Vec3 little_distorted(const Vec3& x) {
  const Real s = std::sin(3.14159265 * x.x) * std::sin(3.14159265 * x.y);
  return {x.x + 0.04 * s * std::sin(6 * x.y), x.y + 0.04 * s * std::cos(3 * x.x), x.z};
}

struct Worst {
  Real angle = 0;  ///< 1 - cos
  Real distance = 0;
};

Worst plane_error(const Mesh& mesh, Vec3 n, const ReconstructAccuracy& accuracy = {}) {
  n = n / norm(n);
  const Vec3 x0{0.52, 0.47, mesh.dim == 3 ? 0.51 : 0};
  CellField<Real> alpha(mesh);
  fill_half_space(alpha, mesh, n, x0);
  Interface interface(mesh);
  ReconstructScratch scratch(mesh);
  reconstruct(interface, alpha, mesh, scratch, accuracy);
  Worst worst;
  geometry::Polytope cell(mesh.dim);
  for (const Index c : interface.cells) {
    const Piece& p = interface.piece[c];
    worst.angle = std::max(worst.angle, norm2(p.n_hat - n) / 2);
    worst.distance = std::max(worst.distance, std::abs(dot(n, p.centre - x0)));
    gather(cell, mesh, c);
    const Real part = geometry::measure_below(cell, {p.n_hat, dot(p.n_hat, p.centre - mesh.C[c])});
    EXPECT_NEAR(part / geometry::measure(cell), alpha[c], 1e-13);
    EXPECT_GT(p.area, 0);
  }
  return {global_max(worst.angle), global_max(worst.distance)};
}

/// The exact plane is the fixed point of the rounds.
TEST(Reconstruct, APlaneIsExactInTheLimit) {
  for (const Index nz : {0, 6}) {
    for (const bool simplex : {false, true}) {
      const Mesh mesh = test::read_box({{6, 6, nz}, {1, 1, 1}, simplex, {}, little_distorted});
      const Worst worst = plane_error(mesh, {0.3, 1, nz > 0 ? -0.2 : 0}, {150, 0, 0});
      EXPECT_LE(worst.angle, 1e-12);
      EXPECT_LE(worst.distance, 1e-12);
    }
  }
}

TEST(Reconstruct, AnyPlaneOnAnyMesh) {
  for (const Index nz : {0, 12}) {
    for (const bool simplex : {false, true}) {
      for (const bool moved : {false, true}) {
        test::BoxFile box{{12, 12, nz}, {1, 1, 1}, simplex};
        if (moved) box.moved = little_distorted;
        const Mesh mesh = test::read_box(box);
        Worst worst;
        for (const Vec3& n : {Vec3{1, 0.3, 0}, {-0.4, 1, 0}, {1, 1, 0}, {-1, -0.2, 0.7}}) {
          if (mesh.dim == 2 && n.z != 0) continue;
          const Worst one = plane_error(mesh, n);
          worst = {std::max(worst.angle, one.angle), std::max(worst.distance, one.distance)};
        }
        if (rank() == 0) {
          std::printf("plane: %dD %s %s 1 - cos %.1e, distance %.1e\n", mesh.dim,
                      simplex ? "simplices" : "boxes", moved ? "moved" : "even", worst.angle,
                      worst.distance);
        }
        // The worst cells lie at the walls, where the gradient of alpha sees one side.
        EXPECT_LE(worst.angle, nz > 0 && simplex ? 1e-2 : 1e-4);
        EXPECT_LE(worst.distance, nz > 0 && simplex ? 5e-4 : 5e-7);
      }
    }
  }
}

/// A ball across a periodic corner has the same planes as one in the middle.
TEST(Reconstruct, PeriodicSeamsDoNotShow) {
  for (const Index nz : {0, 8}) {
    const bool space = nz > 0;
    const Mesh mesh =
        test::box_mesh({.n = {8, 8, nz}, .length = {1, 1, 1}, .periodic = {true, true, space}});
    CellField<Real> alpha(mesh);
    const Vec3 middle{0.53, 0.49, space ? 0.51 : 0}, jump{0.5, 0.5, space ? 0.5 : 0};
    Interface inner(mesh), corner(mesh);
    ReconstructScratch scratch(mesh);
    fill(alpha, mesh, shapes::translate(shapes::sphere(0.3), middle));
    reconstruct(inner, alpha, mesh, scratch);
    CellField<Real> moved(mesh);
    const auto cell_at = [&](Vec3 x) {
      Index c = 0;
      for (int a = 2; a >= 0; --a) {
        if (a == 2 && !space) continue;
        c = 8 * c + static_cast<Index>(std::floor(8 * (x[a] - std::floor(x[a]))));
      }
      return c;
    };
    for (Index c = 0; c < mesh.n_cells; ++c) moved[cell_at(mesh.C[c] + jump)] = alpha[c];
    reconstruct(corner, moved, mesh, scratch);
    ASSERT_EQ(inner.cells.size(), corner.cells.size());
    for (const Index c : inner.cells) {
      const Index k = cell_at(mesh.C[c] + jump);
      EXPECT_LE(norm(inner.piece[c].n_hat - corner.piece[k].n_hat), 1e-12);
      const Vec3 a = inner.piece[c].centre - mesh.C[c], b = corner.piece[k].centre - mesh.C[k];
      EXPECT_LE(norm(a - b), 1e-12);
    }
  }
}

struct SphereError {
  Real normal = 0, position = 0;  ///< means of 1 - n . n_exact and of the distance to the surface
};

SphereError sphere_error(const test::BoxFile& box) {
  const Mesh mesh = test::read_box(box);
  const Vec3 centre{0.5123, 0.4922, mesh.dim == 3 ? 0.5031 : 0};
  const Real radius = 0.25;
  CellField<Real> alpha(mesh);
  fill(alpha, mesh, shapes::translate(shapes::sphere(radius), centre));
  Interface interface(mesh);
  ReconstructScratch scratch(mesh);
  reconstruct(interface, alpha, mesh, scratch);
  Sum normal, position, count;
  for (const Index c : interface.cells) {
    const Piece& p = interface.piece[c];
    const Vec3 r = p.centre - centre;
    normal.add(1 - dot(p.n_hat, r / norm(r))), position.add(std::abs(norm(r) - radius));
    count.add(1);
  }
  const Real n = count.total();
  return {normal.total() / n, position.total() / n};
}

/// Mean errors against those of [Scheufler19] at the same resolution (30 cells per unit length):
/// circle on triangles 3.5e-4, sphere on hexes 2.3e-4. 1 - cos falls with the square of h, so does
/// the position.
TEST(Reconstruct, NormalsOfCircleAndSphere) {
  const SphereError quads = sphere_error({{30, 30, 0}}), fine = sphere_error({{60, 60, 0}});
  EXPECT_LE(quads.normal, 1.1e-4);
  EXPECT_GE(quads.normal / fine.normal, 3);
  EXPECT_GE(quads.position / fine.position, 3.5);
  EXPECT_LE(sphere_error({{30, 30, 30}}).normal, 2.3e-4);
  EXPECT_LE(sphere_error({{30, 30, 0}, {1, 1, 1}, true, {}, little_distorted}).normal, 3.5e-4);
}

TEST(Reconstruct, NoInterfaceNoPlanes) {
  const Mesh mesh = test::read_box({{4, 4, 0}});
  CellField<Real> alpha(mesh, 1);
  Interface interface(mesh);
  ReconstructScratch scratch(mesh);
  reconstruct(interface, alpha, mesh, scratch);
  EXPECT_TRUE(interface.cells.empty());
  for (Index c = 0; c < mesh.n_owned; ++c) alpha[c] = mesh.global_id[c] == 5 ? 1e-6 : 0;
  mesh.halo.update(alpha);
  reconstruct(interface, alpha, mesh, scratch);  // a lone wisp: symmetric, no direction
  EXPECT_TRUE(interface.cells.empty());
}

}  // namespace
}  // namespace fsi::vof
