// The part of solid between the centres of a face's cells.

#include "libfsi/vof/face_fraction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/support/box_file.hpp"

namespace fsi::vof {
namespace {

/// The half space n . (x - x_0) < 0 with its plane in every cell.
struct HalfSpace {
  HalfSpace(const test::BoxFile& box, const Vec3& normal, const Vec3& at)
      : mesh(test::read_box(box)),
        weights(mesh),
        alpha(mesh),
        interface(mesh),
        alpha_f(mesh),
        n(normal / norm(normal)),
        x_0(at) {
    for (Index c = 0; c < mesh.n_cells; ++c) {
      const Real away = dot(n, mesh.C[c] - x_0);
      interface.piece[c] = {n, mesh.C[c] - away * n, 1};
      alpha[c] = away < 0 ? 1 : 0;
    }
    std::vector<Index> faces;
    for (Index f = 0; f < mesh.n_faces; ++f) faces.push_back(f);
    face_fraction(alpha_f, alpha, interface, weights, mesh, faces);
  }
  bool inside(const Vec3& x) const { return dot(n, x - x_0) < 0; }

  Mesh mesh;
  FaceWeights weights;
  CellField<Real> alpha;
  Interface interface;
  FaceField<Real> alpha_f;
  Vec3 n, x_0;
};

// A plane across the faces' d, at 0.3 of the way between two rows of centres.
TEST(FaceFraction, PlaneBetweenTwoCentres) {
  HalfSpace s({.n = {8, 8, 0}}, {0, 1, 0}, {0, (3.5 + 0.3) / 8, 0});
  for (Index f = 0; f < s.mesh.n_internal; ++f) {
    const Real y = s.mesh.Cf[f].y * 8;  // 4 between the centres; 3.5 and 4.5 in their rows
    const bool upward = std::abs(s.mesh.Sf[f].y) > 0;
    const Real row = upward ? std::abs(y - 4) < 0.1 ? 0.3
                              : y < 4               ? 1
                                                    : 0
                            : std::clamp(3.8 - (y - 0.5), 0.0, 1.0);
    EXPECT_NEAR(s.alpha_f[f], row, 1e-13);
  }
}

// Any plane, against samples of the prism that the face sweeps.
TEST(FaceFraction, ObliquePlane) {
  const auto moved = [](const Vec3& x) {
    return Vec3{x.x + 0.03 * std::sin(6 * x.y), x.y + 0.03 * std::cos(5 * x.x), x.z};
  };
  for (const bool simplex : {false, true}) {
    HalfSpace s({.n = {8, 8, 0}, .simplex = simplex, .moved = moved}, {1, 0.6, 0}, {0.5, 0.5, 0});
    constexpr int samples = 100;
    for (Index f = 0; f < s.mesh.n_internal; ++f) {
      const Index P = s.mesh.owner[f];
      const Vec3 a = s.mesh.corner(f, 0, P), b = s.mesh.corner(f, 1, P);
      int count = 0;
      for (int i = 0; i < samples; ++i)
        for (int j = 0; j < samples; ++j) {
          const Real t = (i + 0.5) / samples, r = (j + 0.5) / samples - s.weights.lambda[f];
          if (s.inside(a + t * (b - a) + r * s.mesh.d[f])) ++count;
        }
      EXPECT_NEAR(s.alpha_f[f], static_cast<Real>(count) / (samples * samples), 0.01);
    }
  }
}

// Between the centre of a cell and the wall beside it; whether the solid reaches the wall.
TEST(FaceFraction, FilmAtAWall) {
  HalfSpace s({.n = {8, 8, 0}}, {0, -1, 0}, {0, 0.03, 0});
  for (Index f = s.mesh.n_internal; f < s.mesh.n_faces; ++f) {
    const Vec3& x = s.mesh.Cf[f];
    const bool bottom = x.y < 1e-9, low = x.y < 0.125;
    const Real part = bottom ? (0.0625 - 0.03) / 0.0625 : low ? (0.125 - 0.03) / 0.125 : 1;
    EXPECT_NEAR(s.alpha_f[f], part, 1e-13);
    EXPECT_EQ(touches(f, s.alpha, s.interface, s.mesh), !bottom);
  }
  for (Index c = 0; c < s.mesh.n_cells; ++c) s.interface.piece[c] = {};
  for (Index f = s.mesh.n_internal; f < s.mesh.n_faces; ++f)
    EXPECT_EQ(touches(f, s.alpha, s.interface, s.mesh), s.alpha[s.mesh.owner[f]] == 1);
}

// Where the surface lies in faces, the faces of the two rows of cells at it have its normal, and
// no other face has one, also where cells are full or empty but for rounding.
TEST(FaceNormal, OfTheCellsAtTheSurface) {
  HalfSpace s({.n = {8, 8, 0}}, {0, 1, 0}, {0, 0.5, 0});
  std::vector<Index> faces, cells;
  for (Index f = 0; f < s.mesh.n_faces; ++f) faces.push_back(f);
  for (Index c = 0; c < s.mesh.n_cells; ++c) {
    if (c < s.mesh.n_owned) cells.push_back(c);
    s.interface.piece[c] = {};
    if (c % 2 == 0) s.alpha[c] += s.alpha[c] > 0.5 ? -1e-10 : 1e-10;
  }
  FaceField<Vec3> normal_f(s.mesh);
  CellField<Vec3> normal(s.mesh);
  CellField<Real> height(s.mesh);
  cell_plane(normal, height, s.alpha, s.interface, s.mesh, cells);
  s.mesh.halo.update(normal);
  face_normal(normal_f, normal, s.mesh, faces);
  const auto beside = [&](Index c) { return std::abs(s.mesh.C[c].y - 0.5) < 1.0 / 8; };
  for (Index f = 0; f < s.mesh.n_faces; ++f) {
    const bool near =
        beside(s.mesh.owner[f]) || (f < s.mesh.n_internal && beside(s.mesh.neighbour[f]));
    EXPECT_LE(norm(normal_f[f] - (near ? s.n : Vec3{})), 1e-14);
  }
}

// Between opposed normals there is none.
TEST(FaceNormal, NoneBetweenOpposedOnes) {
  const Mesh mesh = test::read_box({.n = {2, 2, 0}});
  CellField<Vec3> normal(mesh);
  for (Index c = 0; c < mesh.n_cells; ++c) normal[c] = {0, mesh.C[c].y > 0.5 ? 1.0 : -1.0, 0};
  std::vector<Index> faces;
  for (Index f = 0; f < mesh.n_internal; ++f) faces.push_back(f);
  FaceField<Vec3> normal_f(mesh);
  face_normal(normal_f, normal, mesh, faces);
  for (const Index f : faces) {
    const Vec3& n = normal[mesh.owner[f]];
    const bool opposed = std::abs(mesh.Sf[f].y) > 0;
    EXPECT_EQ(norm(normal_f[f] - (opposed ? Vec3{} : n)), 0);
  }
}

// The plane of the cell itself; where the surface lies in faces, those of the cells beside it.
TEST(CellPlane, OfTheCellOrOfItsFaces) {
  HalfSpace s({.n = {8, 8, 0}}, {0, 1, 0}, {0, 0.5, 0});
  std::vector<Index> cells;
  for (Index c = 0; c < s.mesh.n_owned; ++c) cells.push_back(c);
  CellField<Vec3> normal(s.mesh);
  CellField<Real> height(s.mesh);
  const auto expect_plane = [&](bool everywhere) {
    cell_plane(normal, height, s.alpha, s.interface, s.mesh, cells);
    for (const Index c : cells) {
      const Real above = s.mesh.C[c].y - 0.5;
      const bool known = everywhere || std::abs(above) < 1.0 / 8;
      EXPECT_LE(norm(normal[c] - (known ? s.n : Vec3{})), 1e-14);
      EXPECT_NEAR(height[c], known ? above : 0, 1e-14);
    }
  };
  expect_plane(true);
  for (Index c = 0; c < s.mesh.n_cells; ++c) s.interface.piece[c] = {};
  expect_plane(false);
}

// Without a plane the interface lies on the face.
TEST(FaceFraction, WithoutPlanes) {
  HalfSpace s({.n = {8, 8, 0}}, {0, 1, 0}, {0, 0.5, 0});
  for (Index c = 0; c < s.mesh.n_cells; ++c) s.interface.piece[c] = {};
  std::vector<Index> faces(static_cast<std::size_t>(s.mesh.n_faces));
  for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = static_cast<Index>(f);
  face_fraction(s.alpha_f, s.alpha, s.interface, s.weights, s.mesh, faces);
  for (Index f = 0; f < s.mesh.n_faces; ++f) {
    const Real y = s.mesh.Cf[f].y;
    EXPECT_EQ(s.alpha_f[f], std::abs(y - 0.5) < 1e-9 ? 0.5 : y < 0.5 ? 1 : 0);
  }
}

}  // namespace
}  // namespace fsi::vof
