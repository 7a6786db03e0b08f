// Elastic laws: stress against closed forms, energy against power, modulus against the second
// derivative of the energy.

#include "libfsi/solid/law/laws.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "libfsi/core/error.hpp"
#include "libfsi/solid/log_tensor.hpp"
#include "tests/unit/support/box_file.hpp"

namespace fsi::solid {
namespace {

/// A law, and its 2 W_1, 2 W_2 and W by hand.
struct Known {
  Law law;
  std::function<Real(Real)> w1;  ///< 2 W_1 by I1
  Real w2;                       ///< 2 W_2
  std::function<Real(Real, Real)> W;
};

std::vector<Known> known() {
  const Real c = 0.3, J = 4, a = 0.07;
  return {{Law(), [](Real) { return 1; }, 0, [](Real I1, Real) { return (I1 - 3) / 2; }},
          {Law(MooneyRivlin{c}), [=](Real) { return 1 - c; }, c,
           [=](Real I1, Real I2) { return (1 - c) / 2 * (I1 - 3) + c / 2 * (I2 - 3); }},
          {Law(Gent{J}), [=](Real I1) { return J / (J - (I1 - 3)); }, 0,
           [=](Real I1, Real) { return -J / 2 * std::log1p(-(I1 - 3) / J); }},
          {Law("of three terms",
               [=](const Jet& I1, const Jet& I2) {
                 return (I1 - 3) * 0.4 + pow(I1 - 3, 2) * a + (I2 - 3) * 0.1;
               }),
           [=](Real I1) { return 0.8 + 4 * a * (I1 - 3); }, 0.2,
           [=](Real I1, Real I2) {
             return 0.4 * (I1 - 3) + a * (I1 - 3) * (I1 - 3) + 0.1 * (I2 - 3);
           }}};
}

Tensor random_tensor(std::mt19937& random, Real size) {
  std::uniform_real_distribution<Real> any(-size, size);
  Tensor t;
  for (Real* v : {&t.xx, &t.xy, &t.xz, &t.yx, &t.yy, &t.yz, &t.zx, &t.zy}) *v = any(random);
  t.zz = -t.xx - t.yy;
  return t;
}

/// F B F^T.
SymTensor carried(const Tensor& F, const SymTensor& B) {
  const Tensor full{B.xx, B.xy, B.xz, B.xy, B.yy, B.yz, B.xz, B.yz, B.zz};
  const Tensor r = dot(dot(F, full), transpose(F));
  return {r.xx, r.xy, r.xz, r.yy, r.yz, r.zz};
}

/// det B = 1, eigenvalues well within the range of the laws above.
SymTensor random_B(std::mt19937& random, Real size = 0.4) {
  const Tensor t = random_tensor(random, size);
  return exp(SymTensor{t.xx, t.xy, t.xz, t.yy, t.yz, t.zz});
}

/// I + e m (x) n.
Tensor sheared(Real e, const Vec3& m, const Vec3& n) {
  return Tensor{1, 0, 0, 0, 1, 0, 0, 0, 1} + e * outer(m, n);
}

TEST(Laws, Uniaxial) {
  // sigma = (l^2 - 1/l) (2 W_1 + 2 W_2 / l) along, 0 across
  for (const Known& k : known())
    for (const Real l : {0.6, 0.9, 1.0, 1.3, 1.7}) {
      const Response r = k.law.at({l * l, 0, 0, 1 / l, 0, 1 / l});
      const Real I1 = l * l + 2 / l, I2 = 2 * l + 1 / (l * l);
      EXPECT_NEAR(r.T.xx - r.T.yy, (l * l - 1 / l) * (k.w1(I1) + k.w2 / l), 1e-12) << k.law.name();
      EXPECT_NEAR(r.T.yy, r.T.zz, 1e-12);
      EXPECT_NEAR(r.W, k.W(I1, I2), 1e-12);
    }
}

TEST(Laws, SimpleShear) {
  // tau_xy = (2 W_1 + 2 W_2) g, tau_xx - tau_yy = g tau_xy, tau_yy - tau_zz = -2 W_2 g^2: the
  // traction on the planes y = const has the tangential part tau_xy
  for (const Known& k : known())
    for (const Real g : {-1.2, 0.0, 0.3, 1.5}) {
      const Response r = k.law.at({1 + g * g, g, 0, 1, 0, 1});
      const Real I = 3 + g * g, shear = (k.w1(I) + k.w2) * g;
      const Vec3 t = dot(dev(r.T), Vec3{0, 1, 0});
      EXPECT_NEAR(t.x, shear, 1e-12) << k.law.name();
      EXPECT_NEAR(t.z, 0, 1e-12);
      EXPECT_NEAR(r.T.xx - r.T.yy, g * shear, 1e-12);
      EXPECT_NEAR(r.T.yy - r.T.zz, -k.w2 * g * g, 1e-12);
      EXPECT_NEAR(r.W, k.W(I, I), 1e-12);
    }
}

TEST(Laws, Equibiaxial) {
  // sigma = (l^2 - l^-4) (2 W_1 + 2 W_2 l^2) in the plane, 0 across
  for (const Known& k : known())
    for (const Real l : {0.8, 1.0, 1.1, 1.5}) {
      const Real a = l * l, b = 1 / (a * a), I1 = 2 * a + b, I2 = 2 / a + a * a;
      const Response r = k.law.at({a, 0, 0, a, 0, b});
      EXPECT_NEAR(r.T.xx - r.T.zz, (a - b) * (k.w1(I1) + k.w2 * a), 1e-12) << k.law.name();
      EXPECT_NEAR(r.T.yy, r.T.xx, 1e-12);
      EXPECT_NEAR(r.W, k.W(I1, I2), 1e-12);
    }
}

TEST(Laws, TurnWithTheirStrain) {
  std::mt19937 random(1);
  for (const Known& k : known())
    for (int i = 0; i < 20; ++i) {
      const SymTensor B = random_B(random);
      const Vec3 x = eigen(random_B(random)).vector[0], y = eigen(random_B(random)).vector[1];
      const Vec3 n = (1 / norm(cross(x, y))) * cross(x, y);
      // Q = 2 n (x) n - I
      const Tensor Q = 2 * outer(n, n) + -1 * Tensor{1, 0, 0, 0, 1, 0, 0, 0, 1};
      const Response r = k.law.at(B), turned = k.law.at(carried(Q, B));
      const SymTensor rest = turned.T - carried(Q, r.T);
      for (const Real v : {rest.xx, rest.xy, rest.xz, rest.yy, rest.yz, rest.zz})
        EXPECT_NEAR(v, 0, 1e-12) << k.law.name();
      EXPECT_NEAR(turned.W, r.W, 1e-12);
      EXPECT_NEAR(turned.modulus, r.modulus, 1e-11);
    }
}

// dW/dt = tau : D where B moves by dB/dt = L . B + B . L^T.
TEST(Laws, EnergyGrowsByThePowerOfTheStress) {
  std::mt19937 random(2);
  constexpr Real h = 1e-4;
  for (const Known& k : known())
    for (int i = 0; i < 50; ++i) {
      const SymTensor B = random_B(random), tau = dev(k.law.at(B).T);
      const Tensor L = random_tensor(random, 1);
      const auto W = [&](Real e) {
        // exp(e L) to third order
        const Tensor one{1, 0, 0, 0, 1, 0, 0, 0, 1}, LL = dot(L, L);
        const Tensor F = one + e * L + (e * e / 2) * LL + (e * e * e / 6) * dot(L, LL);
        return k.law.at(carried(F, B)).W;
      };
      const Real power = tau.xx * L.xx + tau.yy * L.yy + tau.zz * L.zz + tau.xy * (L.xy + L.yx) +
                         tau.xz * (L.xz + L.zx) + tau.yz * (L.yz + L.zy);
      EXPECT_NEAR((W(h) - W(-h)) / (2 * h), power, 1e-6) << k.law.name();
    }
}

// No wave is faster than the modulus tells, and one is as fast.
TEST(Laws, ModulusIsThatOfTheFastestWave) {
  std::mt19937 random(3);
  std::normal_distribution<Real> normal;
  constexpr Real h = 1e-3;
  const auto modulus = [&](const Law& law, const SymTensor& B, const Vec3& m, const Vec3& n) {
    const auto W = [&](Real e) { return law.at(carried(sheared(e, m, n), B)).W; };
    return (W(h) - 2 * W(0) + W(-h)) / (h * h);
  };
  for (const Known& k : known()) {
    EXPECT_NEAR(k.law.at(identity()).modulus, 1, 1e-14);
    for (int i = 0; i < 20; ++i) {
      const SymTensor B = random_B(random, 0.5);
      const Real expected = k.law.at(B).modulus;
      Real most = 0;
      for (int j = 0; j < 1000; ++j) {
        Vec3 n{normal(random), normal(random), normal(random)},
            m{normal(random), normal(random), 1};
        n *= 1 / norm(n), m -= dot(m, n) * n, m *= 1 / norm(m);
        most = std::max(most, modulus(k.law, B, m, n));
      }
      EXPECT_LT(most, expected * (1 + 1e-5)) << k.law.name();
      const Eigen e = eigen(B);
      for (int j = 0; j < 360; ++j) {
        const Real a = j * 3.14159265358979 / 360;
        const Vec3 n = std::cos(a) * e.vector[2] + std::sin(a) * e.vector[0],
                   m = std::cos(a) * e.vector[0] - std::sin(a) * e.vector[2];
        most = std::max(most, modulus(k.law, B, m, n));
      }
      EXPECT_NEAR(most, expected, 1e-4 * expected) << k.law.name();
    }
  }
}

TEST(Laws, NeoHookeanIsBItself) {
  std::mt19937 random(4);
  const Law law, gent(Gent{1e6});
  EXPECT_TRUE(law.B_itself());
  EXPECT_FALSE(gent.B_itself());
  for (int i = 0; i < 20; ++i) {
    const SymTensor B = random_B(random);
    EXPECT_EQ(law.at(B).T, B);
    EXPECT_NEAR(law.at(B).modulus, eigen(B).value[2], 1e-14);
    EXPECT_NEAR(gent.at(B).modulus, eigen(B).value[2], 1e-4);
  }
}

TEST(Laws, FollowTheirFunctionsOfAJet) {
  // f = exp(x y) / sqrt(y) + log(x) - log1p(y), by hand at (2, 3)
  const Real x = 2, y = 3, e = std::exp(x * y), r = 1 / std::sqrt(y);
  const Jet a = Jet::first(x), b = Jet::second(y);
  const Jet f = exp(a * b) / sqrt(b) + log(a) - log1p(b);
  EXPECT_NEAR(f.f, e * r + std::log(x) - std::log1p(y), 1e-12 * e);
  EXPECT_NEAR(f.d1, y * e * r + 1 / x, 1e-12 * e);
  EXPECT_NEAR(f.d2, x * e * r - e * r / (2 * y) - 1 / (1 + y), 1e-12 * e);
  EXPECT_NEAR(f.d11, y * y * e * r - 1 / (x * x), 1e-11 * e);
  EXPECT_NEAR(f.d12, e * r + x * y * e * r - e * r / 2, 1e-11 * e);
  EXPECT_NEAR(f.d22, e * r * (x * x - x / y + 0.75 / (y * y)) + 1 / ((1 + y) * (1 + y)), 1e-11 * e);
}

TEST(Laws, OfYourOwnAreCheckedAtRest) {
  const auto sentence = [](auto energy) -> std::string {
    try {
      const Law law("mine", energy);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(sentence([](const Jet& I1, const Jet&) { return (I1 - 3) * 0.5; }), "");
  const std::string stiff = sentence([](const Jet& I1, const Jet&) { return I1 - 3; });
  EXPECT_NE(stiff.find("\"mine\": its shear modulus at rest"), std::string::npos) << stiff;
  const std::string high = sentence([](const Jet& I1, const Jet&) { return I1 * 0.5; });
  EXPECT_NE(high.find("\"mine\": its energy at rest"), std::string::npos) << high;
}

// Beyond the range: cells that know their strain say so, others take a root of B.
TEST(Laws, TellWhereTheyEnd) {
  const Mesh mesh = test::read_box({.n = {4, 4, 0}});
  CellField<SymTensor> T(mesh), B(mesh, SymTensor{4, 0, 0, 0.25, 0, 1});
  CellField<Real> modulus(mesh), alpha(mesh, 0.2);
  B[0] = {};
  std::vector<Index> cells;
  for (Index c = 0; c < mesh.n_owned; ++c) cells.push_back(c);
  const Law law(Gent{1});
  const Law::Fields fields{T, modulus, B, alpha, cells, 0.5};
  EXPECT_FALSE(law.at(B[1]).valid());
  EXPECT_TRUE(law.apply(fields));
  EXPECT_EQ(T[0], SymTensor{});
  EXPECT_EQ(modulus[0], 0);
  const Real w1 = 1 / (1 - 0.5);  // of B^(1/2), I1 = 3.5
  EXPECT_NEAR(T[1].xx, 2 * w1, 1e-12);
  EXPECT_TRUE(std::isfinite(law.energy(1, B, alpha, mesh)));
  alpha[1] = 0.5;
  EXPECT_FALSE(law.apply(fields));
}

TEST(Laws, EnergyOfABody) {
  const Mesh mesh = test::read_box({{6, 6, 6}, {1, 1, 1}});
  const CellField<Real> alpha(mesh, 0.5);
  const SymTensor b{2, 0, 0, 0.5, 0, 1};
  const CellField<SymTensor> B(mesh, b);
  for (const Known& k : known())
    EXPECT_NEAR(k.law.energy(8, B, alpha, mesh), 8 * 0.5 * k.W(3.5, 3.5), 1e-13) << k.law.name();
}

}  // namespace
}  // namespace fsi::solid
