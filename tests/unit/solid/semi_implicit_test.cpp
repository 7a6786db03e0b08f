// The implicit share of elasticity and its damping: their coefficients, where they act, and that
// nothing of the last step stays.

#include "libfsi/solid/semi_implicit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "tests/unit/support/box_file.hpp"

namespace fsi::solid {
namespace {

TEST(SemiImplicitElasticity, KappaIsAShareOfTheStressOfAStep) {
  const Mesh mesh = test::read_box({.n = {6, 6, 0}});
  const FaceWeights weights(mesh);
  CellField<Real> alpha(mesh), lambda(mesh, 3);
  for (Index c = 0; c < mesh.n_cells; ++c) alpha[c] = mesh.C[c].x < 0.5 ? 1 : 0;
  Band band(mesh);
  band.rebuild(alpha, 0.5);
  const FaceField<Real> alpha_f(mesh, 0.5);
  const CellField<Vec3> u(mesh);
  const CellField<Tensor> L(mesh);
  const SimplexZone zone(mesh);
  SemiImplicitElasticity elasticity(mesh, weights, zone, {});
  FaceField<Real> kappa(mesh), stiffness(mesh);
  CellField<Vec3> force(mesh);
  const Real G = 2, dt = 0.8;  // so long that e asks for no more
  elasticity.apply(kappa, stiffness, force, {lambda, alpha_f, u, L, alpha, G, 1, 0.01, dt}, weights,
                   band);
  std::vector<char> in_band(static_cast<std::size_t>(mesh.n_faces), 0);
  for (const Index f : band.faces()) in_band[f] = 1;
  Real worst = 0, left = 0;
  for (Index f = 0; f < mesh.n_faces; ++f) {
    const Real all = in_band[f] != 0 ? dt * G * 0.5 * 3 : 0;
    worst = std::max({worst, std::abs(kappa[f] - 0.4 * all), std::abs(stiffness[f] - all)});
  }
  EXPECT_LT(worst, 1e-15);
  for (Index c = 0; c < mesh.n_cells; ++c) EXPECT_EQ(norm(force[c]), 0);  // at rest
  elasticity.clear(kappa, stiffness);
  for (Index f = 0; f < mesh.n_faces; ++f)
    left = std::max(left, std::abs(kappa[f]) + std::abs(stiffness[f]));
  EXPECT_EQ(left, 0);
}

// h (rho / (G lambda))^(1/2), lambda at least 1; no wave without stiffness.
TEST(ElasticTime, OfTheShearWave) {
  const Mesh mesh = test::read_box({.n = {4, 4, 0}});
  std::vector<Index> cells;
  for (Index c = 0; c < mesh.n_owned; ++c) cells.push_back(c);
  const CellField<Real> stretched(mesh, 4), pressed(mesh, 0.25);
  const auto widths = wave_widths(mesh, WaveWidth::of_neighbourhood);  // of squares their own
  EXPECT_NEAR(global_min(elastic_time(stretched, 4, 1, widths, cells)), 0.25 / 4, 1e-14);
  EXPECT_NEAR(global_min(elastic_time(pressed, 4, 1, widths, cells)), 0.25 / 2, 1e-14);
  EXPECT_GT(elastic_time(stretched, 0, 1, widths, cells), 1e300);
}

// A flat triangle has the mean width of the triangles around it.
TEST(WaveWidth, AFlatTriangleDoesNotCount) {
  const Mesh even = test::read_box({.n = {4, 4, 0}, .simplex = true});
  const auto move = [](Vec3 x) { return std::abs(x.x - 0.5) < 1e-9 ? Vec3{0.27, x.y, x.z} : x; };
  const Mesh flat = test::read_box({.n = {4, 4, 0}, .simplex = true, .moved = move});
  const auto least = [](const Mesh& mesh, WaveWidth kind) {
    const auto widths = wave_widths(mesh, kind);
    return global_min(*std::ranges::min_element(widths));
  };
  // V / max |Sf| of the half of a rectangle of a by b is a b / (2 (a^2 + b^2)^(1/2))
  EXPECT_NEAR(least(even, WaveWidth::own), 0.25 / std::sqrt(8.), 1e-14);
  EXPECT_NEAR(least(even, WaveWidth::of_neighbourhood), 0.25 / std::sqrt(8.), 1e-14);
  EXPECT_LT(least(flat, WaveWidth::own), 0.011);
  EXPECT_GT(least(flat, WaveWidth::of_neighbourhood), 0.06);
}

constexpr Real G = 3;

/// ElasticTerms of a disc of lambda = 2 in a velocity field.
struct Stiff {
  explicit Stiff(const std::function<Vec3(const Vec3&)>& velocity)
      : mesh(test::read_box({.n = {8, 8, 0}, .periodic = {"left", "right", "bottom", "top"}})),
        lambda(mesh, 2) {
    for (Index c = 0; c < mesh.n_cells; ++c) {
      alpha[c] = inside(c) ? 1 : 0;
      u[c] = velocity(mesh.C[c]);
    }
    for (Index f = 0; f < mesh.n_internal; ++f)
      share[f] = (alpha[mesh.owner[f]] + alpha[mesh.neighbour[f]]) / 2;
  }
  bool inside(Index c) const { return norm(mesh.C[c] - Vec3{0.5, 0.5, 0}) < 0.3; }
  void apply() {
    band.rebuild(alpha, 0.5);
    const ElasticTerms stiff{.lambda = lambda,
                             .alpha = share,
                             .u = u,
                             .L = L,
                             .fraction = alpha,
                             .G = G,
                             .rho = rho,
                             .mu_s = mu_s,
                             .dt = dt,
                             .kink = kink,
                             .normal = normal ? &*normal : nullptr,
                             .across = across};
    force.fill({});
    elasticity.clear(kappa, stiffness);
    elasticity.apply(kappa, stiffness, force, stiff, weights, band);
  }
  static constexpr Real rho = 2, h = 0.125;
  Real dt = 0.1, mu_s = 0;
  bool kink = false;
  std::optional<FaceField<Vec3>> normal;
  Real across = 0;
  Mesh mesh;
  FaceWeights weights{mesh};
  CellField<Real> lambda, alpha{mesh, 1};
  CellField<Vec3> u{mesh}, force{mesh};
  CellField<Tensor> L{mesh};
  FaceField<Real> share{mesh}, kappa{mesh}, stiffness{mesh};
  Band band{mesh};
  SimplexZone zone{mesh};
  SemiImplicitElasticity elasticity{mesh, weights, zone, {}};
};

Real kappa_of(const Stiff& stiff, Real l) {
  const Real e = Stiff::h * std::sqrt(Stiff::rho * G * l);
  const Real inertia = Stiff::rho * Stiff::h * Stiff::h / (8 * stiff.dt);
  return std::max(0.4 * stiff.dt * G * l, e / 1.5 - inertia);
}

// kappa = max(0.4 dt G lambda, e / 1.5 - mu_rho) on the faces of the solid, of half of it at its
// surface, nothing elsewhere and nothing once it has left.
TEST(SemiImplicitElasticity, LivesInTheSolidOnly) {
  Stiff stiff([](const Vec3&) { return Vec3{}; });
  stiff.apply();
  const Mesh& mesh = stiff.mesh;
  const auto expected = [&](Real l) { return kappa_of(stiff, l); };
  for (Index f = 0; f < mesh.n_internal; ++f) {
    const bool P = stiff.inside(mesh.owner[f]), N = stiff.inside(mesh.neighbour[f]);
    EXPECT_NEAR(stiff.kappa[f], P && N ? expected(2) : P || N ? expected(1) : 0, 1e-14);
  }
  stiff.alpha.fill(0), stiff.lambda.fill(0);
  stiff.apply();
  for (Index f = 0; f < mesh.n_faces; ++f) EXPECT_EQ(stiff.kappa[f], 0);
}

// Nothing acts on a linear velocity; what alternates from cell to cell, which the averaged gradient
// does not see, is pushed back by e g 2 u a face.
TEST(SemiImplicitElasticity, PushesBackOnlyWhatAlternates) {
  Stiff linear([](const Vec3& x) { return Vec3{x.y, 2 * x.x, 0}; });
  Tensor L;
  L.xy = 1, L.yx = 2;
  linear.L.fill(L);
  linear.apply();
  const Mesh& mesh = linear.mesh;
  for (Index c = 0; c < mesh.n_cells; ++c) {
    if (linear.inside(c)) {
      EXPECT_LE(norm(linear.force[c]), 1e-13);
    }
  }
  const auto sign = [](const Vec3& x) { return std::lround(8 * x.x - 0.5) % 2 == 0 ? 1.0 : -1.0; };
  Stiff alternating([&](const Vec3& x) { return Vec3{0, sign(x), 0}; });
  alternating.apply();
  const Real e = Stiff::h * std::sqrt(Stiff::rho * G * 2);
  for (Index c = 0; c < mesh.n_cells; ++c) {
    if (norm(mesh.C[c] - Vec3{0.5, 0.5, 0}) > 0.1) continue;
    const Vec3 pushed = alternating.force[c];
    EXPECT_NEAR(pushed.y, -4 * e / (Stiff::h * Stiff::h) * sign(mesh.C[c]), 1e-10);
  }
}

// The damping does not depend on the step, and it is stable in each: with kappa and the inertia
// mu_rho a velocity that alternates in both directions changes by less than twice of itself.
TEST(SemiImplicitElasticity, DampsAlikeInEveryStep) {
  const auto sign = [](const Vec3& x) {
    return (std::lround(8 * x.x - 0.5) + std::lround(8 * x.y - 0.5)) % 2 == 0 ? 1.0 : -1.0;
  };
  const Real h = Stiff::h, e = h * std::sqrt(Stiff::rho * G * 2);
  for (const Real dt : {1e-3, 1e-2, 3e-2, 0.1, 1.0}) {
    Stiff stiff([&](const Vec3& x) { return Vec3{0, sign(x), 0}; });
    stiff.dt = dt;
    stiff.apply();
    for (Index c = 0; c < stiff.mesh.n_owned; ++c) {
      const Vec3& x = stiff.mesh.C[c];
      if (norm(x - Vec3{0.5, 0.5, 0}) > 0.1) continue;
      EXPECT_NEAR(stiff.force[c].y, -8 * e / (h * h) * sign(x), 1e-9);
      const Real kappa = stiff.kappa[stiff.mesh.cell_faces[c][0]];
      EXPECT_LT(8 * e / (h * h), 2 * (Stiff::rho / dt + 8 * kappa / (h * h)));
    }
  }
}

// u = (U, w x^3 / 6): along the stream the rise of u_y over a face in x changes by U h w x, so that
// the divergence is kappa dt U w. The damping of a cubic is the same flux through all faces. Where
// the body moves by more than half a cell in a step, nothing acts.
TEST(SemiImplicitElasticity, TakesTheChangeAlongThePath) {
  const Real w = 0.07;
  for (const Real U : {0.3, -0.3, 0.7}) {
    Stiff stiff([&](const Vec3& x) { return Vec3{U, w * x.x * x.x * x.x / 6, 0}; });
    for (Index c = 0; c < stiff.mesh.n_cells; ++c) {
      const Real x = stiff.mesh.C[c].x;
      stiff.L[c].yx = w * x * x / 2;
    }
    stiff.apply();
    const Real expected = U < 0.5 ? kappa_of(stiff, 2) * stiff.dt * U * w : 0;
    GlobalIndex inside = 0;
    for (Index c = 0; c < stiff.mesh.n_owned; ++c) {
      if (norm(stiff.mesh.C[c] - Vec3{0.5, 0.5, 0}) > 0.1) continue;
      ++inside;
      EXPECT_NEAR(stiff.force[c].x, 0, 1e-13);
      EXPECT_NEAR(stiff.force[c].y, expected, 1e-13);
    }
    EXPECT_EQ(global_sum(inside), 4);
  }
}

// What the solid's own viscosity damps is not damped twice.
TEST(SemiImplicitElasticity, CountsTheSolidsViscosity) {
  const auto sign = [](const Vec3& x) { return std::lround(8 * x.x - 0.5) % 2 == 0 ? 1.0 : -1.0; };
  const Real whole = Stiff::h * std::sqrt(Stiff::rho * G * 2);
  for (const Real mu_s : {0.9 * whole, 1.1 * whole}) {
    Stiff stiff([&](const Vec3& x) { return Vec3{0, sign(x), 0}; });
    stiff.mu_s = mu_s;
    stiff.apply();
    const Real e = std::max(0.0, whole - mu_s);
    for (Index c = 0; c < stiff.mesh.n_cells; ++c) {
      const Vec3& x = stiff.mesh.C[c];
      if (norm(x - Vec3{0.5, 0.5, 0}) > 0.1) continue;
      EXPECT_NEAR(stiff.force[c].y, -4 * e / (Stiff::h * Stiff::h) * sign(x), 1e-10);
    }
  }
}

// Where the surface passes with the normal along x, what alternates along y is pushed back by the
// whole of e, and what alternates along x by no more than c mu_s, however stiff the solid is.
TEST(SemiImplicitElasticity, ItsStrengthAcrossTheSurfaceIsThatOfTheViscousStress) {
  const Real whole = Stiff::h * std::sqrt(Stiff::rho * G * 2);
  for (const bool across : {false, true})
    for (const Real c : {0.0, 2.0, 1e3}) {
      const auto sign = [&](const Vec3& x) {
        return std::lround(8 * (across ? x.x : x.y) - 0.5) % 2 == 0 ? 1.0 : -1.0;
      };
      Stiff stiff([&](const Vec3& x) { return Vec3{0, sign(x), 0}; });
      stiff.normal.emplace(stiff.mesh, Vec3{1, 0, 0});
      stiff.mu_s = 0.05 * whole, stiff.across = c;
      stiff.apply();
      const Real e = whole - stiff.mu_s;
      const Real left = across ? std::min(e, c * stiff.mu_s) : e;
      for (Index i = 0; i < stiff.mesh.n_cells; ++i) {
        const Vec3& x = stiff.mesh.C[i];
        if (norm(x - Vec3{0.5, 0.5, 0}) > 0.1) continue;
        EXPECT_NEAR(stiff.force[i].y, -4 * left / (Stiff::h * Stiff::h) * sign(x), 1e-10);
      }
    }
}

// Across the surface between two centres u has a kink: no force where each side is linear and L the
// mean of the gradients to both sides; e g (b - a) / 4 d with the plain mean.
TEST(SemiImplicitElasticity, KnowsTheKinkAtTheSurface) {
  const Real at = 0.55, a = 1, b = 3;  // surface, gradients of u_y in solid and fluid
  const auto u_y = [&](Real x) { return x < at ? a * (x - at) : b * (x - at); };
  const Real h = Stiff::h, part = (at - 0.4375) / h;
  for (const bool kink : {true, false}) {
    Stiff stiff([&](const Vec3& x) { return Vec3{0, u_y(x.x), 0}; });
    const Mesh& mesh = stiff.mesh;
    for (Index c = 0; c < mesh.n_cells; ++c) {
      const Real x = mesh.C[c].x;
      stiff.alpha[c] = x < at ? 1 : 0;
      stiff.L[c].yx = (u_y(x + h) - u_y(x - h)) / (2 * h);
    }
    for (Index f = 0; f < mesh.n_internal; ++f) {
      const Real P = stiff.alpha[mesh.owner[f]], N = stiff.alpha[mesh.neighbour[f]];
      stiff.share[f] = P != N ? part : P;
    }
    stiff.kink = kink;
    stiff.apply();
    const Real e = h * std::sqrt(Stiff::rho * G * 2 * part);
    // Delta - d (L_s + L_f) / 2 = (part - 1/2) (a - b) h / 2
    const Real left = kink ? 0 : e / (h * h) * (part - 0.5) / 2 * (a - b) * h;
    for (Index c = 0; c < mesh.n_owned; ++c) {
      if (mesh.C[c].x > at && mesh.C[c].x < at + h) {
        EXPECT_NEAR(stiff.force[c].y, -left, 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace fsi::solid
