// The reference map: exact deformations, its order of transport, its extension, its guard.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libfsi/core/error.hpp"
#include "libfsi/core/parallel.hpp"
#include "libfsi/solid/reference_map.hpp"
#include "tests/unit/solid/full.hpp"

namespace fsi {
namespace {

constexpr Real pi = std::numbers::pi;

using test::largest;
using Full = test::Full<solid::ReferenceMap>;

test::BoxFile plane(Index n, bool simplex, bool periodic) {
  test::BoxFile box{.n = {n, n, 0}, .simplex = simplex};
  if (periodic) box.periodic = {"left", "right", "bottom", "top"};
  return box;
}

void set_flow(Full& run, const std::function<Vec3(const Vec3&)>& u) {
  run.set_phi(u);
  for (Index c = 0; c < run.mesh.n_cells; ++c) run.u[c] = u(run.mesh.C[c]);
}

/// Error of B at t = 1 in the flow u = L . (x - centre) of a whole box, the map being linear.
Real homogeneous(const test::BoxFile& box, const Tensor& L, const SymTensor& B, int steps) {
  Full run(box);
  run.L.fill(L);
  set_flow(run, [&](const Vec3& x) {
    return dot(L, x - Vec3{0.5, 0.5, run.mesh.dim == 3 ? 0.5 : 0});
  });
  for (int i = 0; i < steps; ++i) run.step(1.0 / steps);
  return run.error([&](const Vec3&) { return B; });
}

Tensor shear(Real rate) {
  Tensor L;
  L.xy = rate;
  return L;
}
Tensor spin(Real rate) {
  Tensor L;
  L.xy = -rate, L.yx = rate;
  return L;
}

// d = -u t, through the periods of the mesh; B = I.
TEST(ReferenceMap, TranslationIsExact) {
  for (const test::BoxFile& box : {plane(6, false, true), plane(6, true, true)}) {
    Full run(box);
    const Vec3 u{1, 0.7, 0};
    set_flow(run, [&](const Vec3&) { return u; });
    for (int i = 0; i < 40; ++i) run.step(0.05);
    for (Index c = 0; c < run.mesh.n_cells; ++c)
      EXPECT_LE(norm(run.kinematics.d[c] + 2 * u), 1e-12);
    EXPECT_LE(run.error([](const Vec3&) { return identity(); }), 1e-12);
  }
}

// The map stays linear in space, and a step is of second order in time: in the plane a step of a
// rotation turns and scales, and B is divided by that scale.
TEST(ReferenceMap, RotationLeavesNoStrain) {
  EXPECT_LE(homogeneous(plane(6, false, false), spin(2 * pi), identity(), 200), 1e-11);
  EXPECT_LE(homogeneous(plane(6, true, false), spin(2 * pi), identity(), 200), 1e-11);
}

// B = [[1 + g^2, g], [g, 1]]: the map is linear in time.
TEST(ReferenceMap, SimpleShearIsExact) {
  const Real g = 0.8;
  const SymTensor B{1 + g * g, g, 0, 1, 0, 1};
  EXPECT_LE(homogeneous(plane(6, false, false), shear(g), B, 20), 1e-12);
  EXPECT_LE(homogeneous(plane(6, true, false), shear(g), B, 20), 1e-12);
  EXPECT_LE(homogeneous({.n = {4, 4, 4}}, shear(g), B, 20), 1e-12);
  EXPECT_LE(homogeneous({.n = {4, 4, 4}, .simplex = true}, shear(g), B, 20), 1e-12);
}

// B = diag(e^{2 e}, e^{-2 e}, 1), and diag(e^{2 e}, e^{-e}, e^{-e}) in space.
TEST(ReferenceMap, ExtensionIsOfSecondOrderInTime) {
  const Real e = 0.5;
  Tensor L;
  L.xx = e, L.yy = -e;
  const SymTensor B{std::exp(2 * e), 0, 0, std::exp(-2 * e), 0, 1};
  const auto error = [&](int steps) { return homogeneous(plane(6, true, false), L, B, steps); };
  EXPECT_NEAR(std::log2(error(20) / error(40)), 2, 0.1);
  L.yy = L.zz = -e / 2;
  const SymTensor B3{std::exp(2 * e), 0, 0, std::exp(-e), 0, std::exp(-e)};
  const auto error3 = [&](int steps) { return homogeneous({.n = {4, 4, 4}}, L, B3, steps); };
  EXPECT_NEAR(std::log2(error3(20) / error3(40)), 2, 0.1);
}

// u = (U + sin 2 pi y, V): with y_0 = y - V t, x - xi_x = U t + (cos 2 pi y_0 - cos 2 pi y) /
// (2 pi V), F_xy = g = (sin 2 pi y - sin 2 pi y_0) / V and B = F F^T.
TEST(ReferenceMap, SmoothShearIsOfSecondOrder) {
  constexpr Real U = 0.7, V = 1, t = 0.5;
  for (const bool simplex : {false, true}) {
    const auto error = [&](Index n) {
      Full run(plane(n, simplex, true));
      set_flow(run, [](const Vec3& x) { return Vec3{U + std::sin(2 * pi * x.y), V, 0}; });
      for (Index c = 0; c < run.mesh.n_cells; ++c)
        run.L[c].xy = 2 * pi * std::cos(2 * pi * run.mesh.C[c].y);
      const int steps = static_cast<int>(4 * n);
      for (int i = 0; i < steps; ++i) run.step(t / steps);
      return run.mean_error([&](const Vec3& x) {
        const Real g = (std::sin(2 * pi * x.y) - std::sin(2 * pi * (x.y - V * t))) / V;
        return SymTensor{1 + g * g, g, 0, 1, 0, 1};
      });
    };
    const Real coarse = error(24), fine = error(48), order = std::log2(coarse / fine);
    if (rank() == 0)
      std::printf("reference map in a smooth shear, %s: %.3e %.3e order %.2f\n",
                  simplex ? "triangles" : "quads", coarse, fine, order);
    EXPECT_GE(order, 1.7);
  }
}

// A map that is given is told back by B.
TEST(ReferenceMap, IsSetByItsMapAlone) {
  Full run(plane(8, true, false));
  const Real g = 0.5;
  run.set_map([&](const Vec3& x) { return Vec3{x.x - g * x.y + 3, x.y - 2, 0}; });
  EXPECT_LE(run.error([&](const Vec3&) { return SymTensor{1 + g * g, g, 0, 1, 0, 1}; }), 1e-12);
}

// What changes the volume is told, and leaves det B = 1.
// Of the map kinematics, at rest.
TEST(ReferenceMap, LosesWhatAlternatesOnObliqueQuadsAlone) {
  const auto lost = [](bool simplex, Real slant) {
    test::BoxFile box = plane(8, simplex, false);
    box.moved = [=](const Vec3& x) { return Vec3{x.x + slant * x.y, x.y, 0}; };
    Full run(box);
    solid::ReferenceMap& map = run.kinematics;
    for (Index c = 0; c < run.mesh.n_cells; ++c)
      map.d[c].y = (run.mesh.global_id[c] % 2 == 0 ? 1 : -1) * 1e-4;
    map.resume(run.alpha, run.grad);
    CellField<Vec3> before(run.mesh);
    before.assign(map.d);
    map.transport(run.alpha,
                  {.phi = run.phi,
                   .u = run.u,
                   .L = run.L,
                   .stencil = run.stencil,
                   .weights = run.weights,
                   .wave_speed = 1,
                   .recovery = 1},
                  0.01, run.grad);
    Real most = 0;
    for (Index c = 0; c < run.mesh.n_owned; ++c) most = std::max(most, norm(map.d[c] - before[c]));
    return global_max(most);
  };
  EXPECT_EQ(lost(false, 0), 0);
  EXPECT_GT(lost(false, 0.5), 1e-8);
  EXPECT_EQ(lost(true, 0), 0);
  EXPECT_EQ(lost(true, 0.5), 0);
}

TEST(ReferenceMap, VolumeIsNormalised) {
  Full run({.n = {4, 4, 4}});
  run.set_map([](const Vec3& x) { return 1.1 * x; });
  EXPECT_LE(run.error([](const Vec3&) { return identity(); }), 1e-12);
  EXPECT_NEAR(run.kinematics.volume_ratio(0), 1.331, 1e-12);
}

// xi = -x folds the plane along a line: the step fails.
TEST(ReferenceMap, AFoldedMapIsRefused) {
  Full run(plane(8, false, false));
  run.set_map([](const Vec3& x) { return Vec3{-x.x, x.y, 0}; });
  try {
    run.step(0.01);
    ADD_FAILURE() << "a folded map was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::numerics);
  }
}

// A linear map known in a disc or ball goes on three rings beyond it, no further, on any mesh.
TEST(MapExtension, IsExactForALinearMap) {
  const Tensor A{0.6, 0.3, 0.1, -0.2, 0.9, 0.2, 0.1, -0.3, 0.7};
  for (const test::BoxFile& box :
       {plane(16, false, true), plane(16, true, false), test::BoxFile{.n = {12, 12, 12}},
        test::BoxFile{.n = {8, 8, 8}, .simplex = true}}) {
    Full run(box);
    const Mesh& mesh = run.mesh;
    CellField<Real> ring(mesh);
    for (Index c = 0; c < mesh.n_cells; ++c) {
      const Real r = norm(mesh.C[c] - Vec3{0.5, 0.5, mesh.dim == 3 ? 0.5 : 0});
      ring[c] = run.alpha[c] = r < 0.25 ? 1 : 0;
    }
    const auto xi = [&](const Vec3& x) {
      Vec3 y = dot(A, x) + Vec3{1, 2, 3};
      if (mesh.dim == 2) y.z = 0;
      return y;
    };
    run.set_map(xi);
    for (int i = 0; i < 3; ++i) {
      CellField<Real> wider(mesh);
      for (Index c = 0; c < mesh.n_owned; ++c) {
        wider[c] = ring[c];
        for (const Index n : mesh.cell_neighbours[c]) wider[c] = std::max(wider[c], ring[n]);
      }
      mesh.halo.update(wider);
      ring.swap(wider);
    }
    for (Index c = 0; c < mesh.n_cells; ++c) {
      EXPECT_EQ(run.kinematics.is_set[c], ring[c]);
      const Vec3 exact = ring[c] > 0 ? xi(mesh.C[c]) - mesh.C[c] : Vec3{};
      EXPECT_LE(norm(run.kinematics.d[c] - exact), 1e-12);
    }
  }
}

// At a wall that the solid is bonded to the map is zero, in the rings beyond the known cells too.
// So the shape of a solid that is pulled off its foot reaches the wall, and alpha is held to it.
TEST(MapExtension, BeyondTheKnownCellsABondHoldsTheMapToo) {
  for (const bool simplex : {false, true}) {
    Full run(plane(12, simplex, false));
    const Mesh& mesh = run.mesh;
    std::vector<char> floor(static_cast<std::size_t>(mesh.n_boundary()), 0);
    for (Index f = mesh.n_internal; f < mesh.n_faces; ++f)
      floor[f - mesh.n_internal] = mesh.Cf[f].y < 1e-9;
    run.kinematics.hold(floor);
    for (Index c = 0; c < mesh.n_cells; ++c) run.alpha[c] = mesh.C[c].x < 0.5 ? 1 : 0;
    const auto beside = [&](const Vec3& x) { return x.x > 0.5 && x.x < 0.7 && x.y < 1.0 / 12; };
    // A shear, which is zero at the floor, is continued exactly.
    const Vec3 shear{0.3, -0.1, 0};
    run.set_map([&](const Vec3& x) { return x + x.y * shear; });
    for (Index c = 0; c < mesh.n_owned; ++c)
      EXPECT_LE(beside(mesh.C[c]) ? norm(run.kinematics.d[c] - mesh.C[c].y * shear) : 0, 1e-12);
    // A shift of all known cells does not reach the floor.
    run.set_map([](const Vec3& x) { return x + Vec3{0.1, 0, 0}; });
    int count = 0;
    for (Index f = mesh.n_internal; f < mesh.n_faces; ++f) {
      const Index c = mesh.owner[f];
      if (floor[f - mesh.n_internal] == 0 || !beside(mesh.C[c])) continue;
      EXPECT_LE(norm(run.kinematics.d[c]), 0.06) << mesh.C[c].x;
      ++count;
    }
    EXPECT_GT(global_max(count), 0);
  }
}

// Where d was not set the cell is not known, however full it becomes: it has no map to carry.
TEST(MapExtension, CellsWithoutAMapStayUnknown) {
  Full run(plane(16, false, false));
  const Mesh& mesh = run.mesh;
  for (Index c = 0; c < mesh.n_cells; ++c) run.alpha[c] = mesh.C[c].x < 0.25 ? 1 : 0;
  run.kinematics.resume(run.alpha, run.grad);
  run.alpha.fill(1);
  run.step(0.01);
  for (Index c = 0; c < mesh.n_cells; ++c)
    EXPECT_EQ(run.kinematics.is_set[c] > 0, mesh.C[c].x < 0.25 + 6.0 / 16);
}

}  // namespace
}  // namespace fsi
