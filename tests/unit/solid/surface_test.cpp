// The solid at its surface and where it meets a wall.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libfsi/solid/elastic_force.hpp"
#include "libfsi/solid/log_conformation.hpp"
#include "libfsi/solid/one_sided.hpp"
#include "libfsi/solid/pressure_jump.hpp"
#include "libfsi/vof/face_fraction.hpp"
#include "tests/unit/solid/full.hpp"

namespace fsi {
namespace {

std::vector<Index> owned(const Mesh& mesh) {
  std::vector<Index> cells;
  for (Index c = 0; c < mesh.n_owned; ++c) cells.push_back(c);
  return cells;
}

// One row of solid along a wall tells nothing of what changes across it; the wall does.
TEST(OneSided, TakesTheWallThatTheSolidTouches) {
  const Tensor L{1, 2, 0, 0.5, -1, 0, 0, 0, 0}, given{9, 9, 9, 9, 9, 9, 9, 9, 9};
  const Mesh mesh = test::read_box({.n = {8, 8, 0}});
  CellField<Vec3> u(mesh);
  for (Index c = 0; c < mesh.n_cells; ++c)
    u[c] = dot(L, mesh.C[c]) + (mesh.C[c].y > 0.125 ? 7 * mesh.C[c].y : 0) * Vec3{1, 3, 0};
  const CellField<Tensor> field(mesh, given);
  const auto known = [&](Index c) { return mesh.C[c].y < 0.125; };
  const auto none = [](Index) { return false; };
  for (const Index c : owned(mesh)) {
    if (!known(c)) continue;
    Vec3 at_wall;
    const auto wall = [&](Index f) -> const Vec3* {
      if (std::abs(mesh.Cf[f].y) > 1e-9) return nullptr;
      at_wall = dot(L, mesh.C[c] + mesh.d[f]);
      return &at_wall;
    };
    const Tensor with = solid::one_sided_gradient(field, u, known, none, wall, mesh, c);
    EXPECT_LE(std::abs(with.xx - L.xx) + std::abs(with.xy - L.xy), 1e-12);
    EXPECT_LE(std::abs(with.yx - L.yx) + std::abs(with.yy - L.yy), 1e-12);
    const Tensor without =
        solid::one_sided_gradient(field, u, known, none, solid::nowhere, mesh, c);
    EXPECT_NEAR(without.xy, 9, 1e-12);
  }
}

/// A log-conformation of one strain in the cells that `filled` names.
template <class Filled>
struct Cells {
  Cells(const SymTensor& psi, const Filled& filled) : run({.n = {12, 12, 0}}) {
    for (Index c = 0; c < run.mesh.n_cells; ++c) {
      const Vec3 x = 12 * run.mesh.C[c] - Vec3{0.5, 0.5, 0};
      run.alpha[c] =
          filled(static_cast<int>(std::lround(x.x)), static_cast<int>(std::lround(x.y))) ? 1 : 0;
      run.kinematics.psi[c] = run.alpha[c] * psi;
    }
    run.kinematics.resume(run.alpha, run.grad);
  }
  Real strain_at(int i, int j) const {
    Real found = 0;
    for (const Index c : owned(run.mesh))
      if (norm(12 * run.mesh.C[c] - Vec3{i + 0.5, j + 0.5, 0}) < 0.1)
        found = run.kinematics.psi[c].xy;
    return global_max(found);
  }
  test::Full<solid::LogConformation> run;
};

// A single cell bears no strain, two of them do; one at the corner of a body has that body's.
TEST(LogConformation, ASpeckHasNoStrainOfItsOwn) {
  const SymTensor psi{0, 1, 0, 0, 0, 0};
  const auto speck = [](int i, int j) { return i == 5 && j == 5; };
  EXPECT_EQ(Cells(psi, speck).strain_at(5, 5), 0);
  const auto pair = [](int i, int j) { return (i == 5 || i == 6) && j == 5; };
  EXPECT_EQ(Cells(psi, pair).strain_at(5, 5), 1);
  const auto corner = [](int i, int j) { return (i < 5 && j < 5) || (i == 5 && j == 5); };
  Cells run(psi, corner);
  EXPECT_NEAR(run.strain_at(5, 5), 1, 1e-14);
}

// Away from the body a speck leaves nothing behind; where the body comes to it, it takes the
// body's.
TEST(LogConformation, ASpeckComesAndGoes) {
  const SymTensor psi{0, 1, 0, 0, 0, 0};
  Cells cells(psi, [](int i, int j) { return (i < 5 && j < 5) || (i == 9 && j == 9); });
  const Mesh& mesh = cells.run.mesh;
  auto& alpha = cells.run.alpha;
  auto& kinematics = cells.run.kinematics;
  EXPECT_EQ(cells.strain_at(9, 9), 0);
  const auto fill = [&](Index i, Index j, Real part) {
    for (Index c = 0; c < mesh.n_cells; ++c)
      if (norm(12 * mesh.C[c] - Vec3{i + 0.5, j + 0.5, 0}) < 0.1) alpha[c] = part;
  };
  fill(9, 9, 0), fill(6, 3, 1);  // a gap of one cell to the body
  kinematics.resume(alpha, cells.run.grad);
  EXPECT_EQ(cells.strain_at(9, 9), 0);
  EXPECT_NEAR(cells.strain_at(6, 3), 1, 1e-14);
  fill(5, 3, 1);
  kinematics.resume(alpha, cells.run.grad);
  EXPECT_NEAR(cells.strain_at(6, 3), 1, 1e-14);
}

// The pressure that bears a level stress goes on with the surface, whichever way that goes.
TEST(CarriedPressure, TheJumpGoesWithTheSurface) {
  constexpr Real G = 3;
  const SymTensor B{1.5, 0.2, 0, 0.8, 0, 1};
  const Mesh mesh = test::read_box({.n = {16, 4, 0}, .periodic = {"bottom", "top"}});
  const auto part = [&](Index c, Real left, Real right) {
    const Real x = mesh.C[c].x, h = 1.0 / 16;
    const Real low = std::max(left, x - h / 2), high = std::min(right, x + h / 2);
    return std::max<Real>(0, high - low) / h;
  };
  CellField<Real> p(mesh), alpha(mesh), alpha_mid(mesh);
  const CellField<SymTensor> B_c(mesh, B);
  const Real s = G * dev(B).xx;
  for (Index c = 0; c < mesh.n_cells; ++c) {
    const Real before = part(c, 0.3, 0.7);
    alpha[c] = part(c, 0.32, 0.73);
    alpha_mid[c] = (before + alpha[c]) / 2;
    p[c] = s * before;
  }
  const auto cells = owned(mesh);
  solid::advect_pressure_jump(p, alpha_mid, alpha, B_c, G, mesh, cells);
  for (const Index c : cells) EXPECT_NEAR(p[c], s * alpha[c], 1e-13);
}

// Half of the way from the centre of a cell to the wall is fluid: the shear stress of the solid
// acts over the other half of the distance over which the wall's viscous stress is taken.
TEST(ElasticForce, AFilmAtAWall) {
  constexpr Real G = 3, y_0 = 1.0 / 32;
  const SymTensor B{1, 0.4, 0, 1, 0, 1};
  const Mesh mesh = test::read_box({.n = {8, 8, 0}, .periodic = {"left", "right"}});
  const FaceWeights weights(mesh);
  PressureStencil stencil(mesh, weights, std::vector<bool>(mesh.patches.size(), false));
  CellField<Real> alpha(mesh, 1);
  vof::Interface interface(mesh);
  for (Index c = 0; c < mesh.n_cells; ++c)
    if (mesh.C[c].y < 0.125)
      alpha[c] = 0.75, interface.piece[c] = {{0, -1, 0}, {mesh.C[c].x, y_0, 0}, 0.125};
  std::vector<Index> faces;
  for (Index f = 0; f < mesh.n_faces; ++f) faces.push_back(f);
  FaceField<Real> alpha_f(mesh), rhie_chow_source(mesh);
  FaceField<Vec3> normal_f(mesh);
  CellField<Vec3> normal(mesh);
  for (Index c = 0; c < mesh.n_cells; ++c) normal[c] = interface.piece[c].n_hat;
  vof::face_fraction(alpha_f, alpha, interface, weights, mesh, faces);
  vof::face_normal(normal_f, normal, mesh, faces);
  const CellField<SymTensor> B_c(mesh, B);
  CellField<Vec3> force(mesh);
  CellField<solid::SymGradient> grad(mesh);
  Band band(mesh);
  band.rebuild(alpha, 0.1);
  solid::ElasticForce law(mesh, weights, G);
  law.apply(force, rhie_chow_source, {B_c, alpha, &alpha_f, &normal_f}, weights, stencil, band,
            grad);
  for (const Index c : owned(mesh)) {
    const Real y = mesh.C[c].y;
    EXPECT_NEAR(force[c].x, y < 0.125 ? 0.5 * G * B.xy * 8 : 0, 1e-12);
    EXPECT_NEAR(force[c].y, 0, 1e-12);
  }
}

}  // namespace
}  // namespace fsi
