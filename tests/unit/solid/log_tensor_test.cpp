// exp and log of symmetric tensors: against a power series in extended precision, and there and
// back, for stretches that are equal, nearly equal or far apart. Errors are told in round-offs.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "libfsi/solid/log_tensor.hpp"
#include "tests/unit/solid/full.hpp"

namespace fsi {
namespace {

constexpr Real eps = std::numeric_limits<Real>::epsilon();

using test::largest;
using Long = std::array<std::array<long double, 3>, 3>;

Long product(const Long& a, const Long& b) {
  Long c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

/// exp(psi) = (sum_n (psi / 2^s)^n / n!)^(2^s).
SymTensor series(const SymTensor& psi) {
  constexpr int squarings = 10, terms = 24;
  const auto x = [](Real v) { return std::ldexp(static_cast<long double>(v), -squarings); };
  const Long a{{{x(psi.xx), x(psi.xy), x(psi.xz)},
                {x(psi.xy), x(psi.yy), x(psi.yz)},
                {x(psi.xz), x(psi.yz), x(psi.zz)}}};
  Long term{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, sum = term;
  for (int n = 1; n < terms; ++n) {
    term = product(term, a);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) term[i][j] /= n, sum[i][j] += term[i][j];
  }
  for (int s = 0; s < squarings; ++s) sum = product(sum, sum);
  const auto y = [&](std::size_t i, std::size_t j) { return static_cast<Real>(sum[i][j]); };
  return {y(0, 0), y(0, 1), y(0, 2), y(1, 1), y(1, 2), y(2, 2)};
}

struct Worst {
  Real exp = 0, log = 0, back = 0;

  void add(const SymTensor& psi) {
    const SymTensor B = solid::exp(psi), reference = series(psi);
    const Eigen e = eigen(psi);
    const Real top = std::exp(e.value[2]), spread = std::exp(e.value[2] - e.value[0]);
    const Real size = 1 + std::max(std::abs(e.value[0]), std::abs(e.value[2]));
    ASSERT_GT(eigen(B).value[0], 0);
    exp = std::max(exp, largest(B - reference) / (eps * size * top));
    // B holds its smallest eigenvalue to round-off of its largest only: log loses as much.
    log = std::max(log, largest(solid::log(B) - psi) / (eps * (size + spread)));
    back = std::max(back, largest(solid::exp(solid::log(B)) - B) / (eps * size * top));
  }

  void judge(const char* kind) const {
    std::printf("%-24s exp %4.1f  log(exp) %4.1f  exp(log) %4.1f round-offs\n", kind, exp, log,
                back);
    EXPECT_LE(exp, 12);
    EXPECT_LE(log, 16);
    EXPECT_LE(back, 20);
  }
};

struct Dice {
  std::mt19937_64 engine{5};
  Real operator()(Real low, Real high) {
    return std::uniform_real_distribution<Real>(low, high)(engine);
  }
  SymTensor tensor(Real s) {
    Dice& d = *this;
    return {d(-s, s), d(-s, s), d(-s, s), d(-s, s), d(-s, s), d(-s, s)};
  }
  SymTensor with_values(const Vec3& values) {
    const Eigen frame = eigen(tensor(1));
    SymTensor sum;
    for (int i = 0; i < 3; ++i) {
      const Vec3& v = frame.vector[static_cast<std::size_t>(i)];
      sum +=
          values[i] * SymTensor{v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
    }
    return sum;
  }
};

TEST(LogTensorRoundTrip, FromUndeformedToStretchesOfAMillion) {
  Dice dice;
  for (const Real size : {1e-12, 1e-8, 1e-4, 1e-2, 1.0, 3.0}) {
    Worst any, isochoric;
    for (int i = 0; i < 2000; ++i) {
      any.add(dice.tensor(size));
      isochoric.add(dev(dice.tensor(size)));
    }
    char kind[32];
    std::snprintf(kind, sizeof kind, "psi of size %g", size);
    any.judge(kind);
    isochoric.judge("  its trace taken out");
  }
}

TEST(LogTensorRoundTrip, EqualAndNearlyEqualStretches) {
  Dice dice;
  for (const Real gap : {0.0, 1e-15, 1e-12, 1e-8, 1e-4}) {
    Worst worst;
    for (int i = 0; i < 1000; ++i) {
      const Real a = dice(-3, 3);
      worst.add(dice.with_values({a, a * (1 + gap), dice(-3, 3)}));
      worst.add(dice.with_values({a, a * (1 + gap), a * (1 - gap)}));
    }
    char kind[32];
    std::snprintf(kind, sizeof kind, "relative gap %g", gap);
    worst.judge(kind);
  }
}

TEST(LogTensorRoundTrip, PlaneDiagonalAndUndeformed) {
  Dice dice;
  Worst plane, diagonal;
  for (int i = 0; i < 2000; ++i) {
    const SymTensor t = dice.tensor(3);
    plane.add({t.xx, t.xy, 0, -t.xx, 0, 0});
    diagonal.add({t.xx, 0, 0, t.yy, 0, t.zz});
    const SymTensor flat = solid::log(solid::exp(SymTensor{t.xx, t.xy, 0, -t.xx, 0, 0}));
    EXPECT_EQ(flat.xz, 0);
    EXPECT_EQ(flat.yz, 0);
    EXPECT_EQ(flat.zz, 0);
  }
  plane.judge("plane strain");
  diagonal.judge("diagonal");
  EXPECT_EQ(solid::exp(SymTensor{}), identity());
  EXPECT_EQ(solid::log(identity()), SymTensor{});
}

}  // namespace
}  // namespace fsi
