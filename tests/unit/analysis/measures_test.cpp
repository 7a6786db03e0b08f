#include "libfsi/analysis/measures.hpp"

#include <gtest/gtest.h>

#include "libfsi/analysis/probe.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi::analysis {
namespace {

Mesh box(Index n = 6) { return test::read_box({{n, n, n}, {1, 1, 1}}); }

TEST(Measures, HealthLooksAtTheSolidOnly) {
  const Mesh mesh = box();
  CellField<Real> alpha(mesh, 0);
  CellField<SymTensor> B(mesh, SymTensor{-5, 0, 0, 1, 0, 1});
  EXPECT_EQ(health(B, alpha, mesh).eigenvalue_min, 1);
  for (Index c = 0; c < mesh.n_owned; ++c) {
    if (mesh.global_id[c] == 10) alpha[c] = 1, B[c] = {2, 1, 0, 2, 0, 1};
    if (mesh.global_id[c] == 200) alpha[c] = 0.6, B[c] = {2, 0, 0, 0.5, 0, 0.25};
  }
  const Health h = health(B, alpha, mesh);
  EXPECT_DOUBLE_EQ(h.det_min, 0.25);
  EXPECT_DOUBLE_EQ(h.det_max, 3);
  EXPECT_DOUBLE_EQ(h.eigenvalue_min, 0.25);
}

TEST(Measures, KineticEnergy) {
  const Mesh mesh = box();
  const CellField<Real> rho(mesh, 2);
  const CellField<Vec3> u(mesh, Vec3{3, 0, 4});
  EXPECT_NEAR(kinetic_energy(rho, u, mesh), 25, 1e-13);
}

TEST(Measures, QOfRotationStrainAndShear) {
  const Mesh mesh = box(2);
  CellField<Tensor> L(mesh);
  CellField<Real> Q(mesh);
  const auto q = [&](const Tensor& l) {
    L.fill(l);
    q_criterion(Q, L);
    return Q[0];
  };
  Tensor rotation, strain, shear;
  rotation.xy = -3, rotation.yx = 3;  // |W|^2 = 18
  strain.xx = 2, strain.yy = -2;      // |D|^2 = 8
  shear.xy = 5;
  EXPECT_DOUBLE_EQ(q(rotation), 9);
  EXPECT_DOUBLE_EQ(q(strain), -4);
  EXPECT_DOUBLE_EQ(q(shear), 0);
}

TEST(Measures, DissipationOfShearAndOfRotation) {
  const Mesh mesh = box();
  const CellField<Real> mu(mesh, 0.2);
  Tensor shear, rotation;
  shear.xy = 3;  // 2 mu D : D = mu * 9
  rotation.xy = -3, rotation.yx = 3;
  EXPECT_NEAR(dissipation(mu, CellField<Tensor>(mesh, shear), mesh), 1.8 * mesh.total_volume,
              1e-13);
  EXPECT_NEAR(dissipation(mu, CellField<Tensor>(mesh, rotation), mesh), 0, 1e-15);
}

TEST(Measures, NormsOfAKnownError) {
  const Mesh mesh = box();
  const Norms n = norms(mesh, [&](Index c) { return mesh.C[c].x < 0.5 ? 3.0 : -1.0; });
  EXPECT_NEAR(n.l1, 2, 1e-14);
  EXPECT_NEAR(n.l2, std::sqrt(5.0), 1e-14);
  EXPECT_EQ(n.linf, 3);
  EXPECT_NEAR(norms(mesh, [](Index) { return Vec3{3, 4, 0}; }).l2, 5, 1e-13);
}

TEST(Measures, ProbeIsExactForLinearFields) {
  const Mesh mesh = box();
  CellField<Real> value(mesh);
  CellField<Vec3> u(mesh);
  const CellField<Vec3> gradient(mesh, Vec3{1, 2, 3});
  Tensor l;
  l.xy = 4, l.zx = -1;
  const CellField<Tensor> L(mesh, l);
  for (Index c = 0; c < mesh.n_cells; ++c) {
    value[c] = dot(gradient[c], mesh.C[c]);
    u[c] = dot(l, mesh.C[c]);
  }
  for (const Vec3& x : {Vec3{0.11, 0.52, 0.87}, {0.5, 0.5, 0.5}, {0, 0, 1}}) {
    const Probe at = probe(mesh, x);
    EXPECT_NEAR(sample(at, value, gradient), dot(Vec3{1, 2, 3}, x), 1e-14);
    EXPECT_NEAR(norm(sample(at, u, L) - dot(l, x)), 0, 1e-14);
  }
}

}  // namespace
}  // namespace fsi::analysis
