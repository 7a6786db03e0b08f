// The eigenproblem of a symmetric tensor against LAPACK's dsyev, over tensors of every scale,
// spread and kind of degeneracy. Errors are told in round-offs of the tensor's norm.

#include <gtest/gtest.h>
#include <petscsys.h>
// needs the one above
#include <petscblaslapack.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <random>

#include "libfsi/core/eigen.hpp"

namespace fsi {
namespace {

constexpr Real eps = std::numeric_limits<Real>::epsilon();

using Matrix = std::array<std::array<Real, 3>, 3>;

Matrix matrix(const SymTensor& t) {
  return {{{t.xx, t.xy, t.xz}, {t.xy, t.yy, t.yz}, {t.xz, t.yz, t.zz}}};
}

Real size(const Matrix& a) {
  Real largest = 0;
  for (const auto& row : a)
    for (const Real x : row) largest = std::max(largest, std::abs(x));
  if (largest == 0) return 0;
  Real sum = 0;
  for (const auto& row : a)
    for (const Real x : row) sum += (x / largest) * (x / largest);
  return largest * std::sqrt(sum);
}

std::array<Real, 3> lapack(const SymTensor& t) {
  Matrix a = matrix(t);
  std::array<Real, 3> value{};
  std::array<Real, 64> work{};
  const PetscBLASInt n = 3, length = static_cast<PetscBLASInt>(work.size());
  PetscBLASInt info = 0;
  LAPACKsyev_("V", "U", &n, a[0].data(), &n, value.data(), work.data(), &length, &info);
  EXPECT_EQ(info, 0);
  return value;
}

/// Largest errors, in round-offs.
struct Worst {
  Real value = 0, frame = 0, residual = 0, sum = 0;

  void add(const SymTensor& t) {
    const Eigen e = eigen(t);
    const Matrix a = matrix(t);
    const Real unit = eps * size(a);
    const auto worse = [](Real& worst, Real error, Real scale) {
      ASSERT_TRUE(std::isfinite(error));
      if (error != 0) worst = std::max(worst, error / scale);
    };
    const std::array<Real, 3> reference = lapack(t);
    ASSERT_LE(e.value[0], e.value[1]);
    ASSERT_LE(e.value[1], e.value[2]);
    ASSERT_GT(dot(cross(e.vector[0], e.vector[1]), e.vector[2]), 0.5);
    for (std::size_t i = 0; i < 3; ++i) {
      worse(value, std::abs(e.value[i] - reference[i]), unit);
      const Vec3 at = dot(t, e.vector[i]) - e.value[i] * e.vector[i];
      worse(residual, std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}), unit);
      for (std::size_t j = 0; j < 3; ++j)
        worse(frame, std::abs(dot(e.vector[i], e.vector[j]) - (i == j ? 1 : 0)), eps);
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        Real rebuilt = 0;
        for (std::size_t k = 0; k < 3; ++k) rebuilt += e.value[k] * e.vector[k][i] * e.vector[k][j];
        worse(sum, std::abs(rebuilt - a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]),
              unit);
      }
  }

  void judge(const char* kind) const {
    std::printf("%-28s eigenvalue %4.1f  frame %4.1f  residual %4.1f  sum %4.1f round-offs\n", kind,
                value, frame, residual, sum);
    EXPECT_LE(value, 12);
    EXPECT_LE(frame, 24);
    EXPECT_LE(residual, 5);
    EXPECT_LE(sum, 15);
  }
};

struct Dice {
  std::mt19937_64 engine{11};
  Real operator()(Real low, Real high) {
    return std::uniform_real_distribution<Real>(low, high)(engine);
  }
  SymTensor tensor() {
    Dice& d = *this;
    return {d(-1, 1), d(-1, 1), d(-1, 1), d(-1, 1), d(-1, 1), d(-1, 1)};
  }
  Vec3 direction() {
    std::normal_distribution<Real> normal;
    const Vec3 v{normal(engine), normal(engine), normal(engine)};
    return v / norm(v);
  }
  /// A tensor with these eigenvalues, up to round-off of the largest.
  SymTensor with_values(const Vec3& values) {
    const Vec3 a = direction(), b = direction(), z = cross(a, b) / norm(cross(a, b)),
               y = cross(z, a);
    SymTensor sum;
    for (const auto& [l, v] : {std::pair{values.x, a}, {values.y, y}, {values.z, z}})
      sum += l * SymTensor{v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
    return sum;
  }
};

TEST(EigenAgainstLapack, RandomTensorsOfEveryScale) {
  Dice dice;
  Worst one, tiny_to_huge;
  for (int i = 0; i < 20000; ++i) {
    one.add(dice.tensor());
    tiny_to_huge.add(std::pow(10, dice(-290, 290)) * dice.tensor());
  }
  one.judge("of order one");
  tiny_to_huge.judge("1e-290 to 1e290");
}

TEST(EigenAgainstLapack, ComponentsOfDifferentScale) {
  Dice dice;
  Worst each, graded;
  for (int i = 0; i < 20000; ++i) {
    SymTensor t = dice.tensor();
    for (Real* x : {&t.xx, &t.xy, &t.xz, &t.yy, &t.yz, &t.zz}) *x *= std::pow(10, dice(-20, 20));
    each.add(t);
    const Vec3 d{std::pow(10, dice(-8, 8)), std::pow(10, dice(-8, 8)), std::pow(10, dice(-8, 8))};
    const SymTensor a = dice.tensor();
    graded.add({a.xx * d.x * d.x, a.xy * d.x * d.y, a.xz * d.x * d.z, a.yy * d.y * d.y,
                a.yz * d.y * d.z, a.zz * d.z * d.z});
  }
  each.judge("each 1e-20 to 1e20");
  graded.judge("D A D, D 1e-8 to 1e8");
}

TEST(EigenAgainstLapack, EqualAndNearlyEqualValues) {
  Dice dice;
  for (const Real gap : {0.0, 1e-15, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4}) {
    Worst worst;
    for (int i = 0; i < 2000; ++i) {
      const Real s = std::pow(10, dice(-30, 30)), other = dice(-3, 3);
      worst.add(dice.with_values(s * Vec3{1, 1 + gap, other}));
      worst.add(dice.with_values(s * Vec3{1, 1 + gap, 1 - gap}));
      // equal up to a small tensor, as B near the undeformed state is
      worst.add(s * (identity() + gap * dice.tensor()));
    }
    char kind[32];
    std::snprintf(kind, sizeof kind, "relative gap %g", gap);
    worst.judge(kind);
  }
}

TEST(EigenAgainstLapack, DiagonalPlaneRankOneAndZero) {
  Dice dice;
  Worst diagonal, plane, rank_one;
  for (int i = 0; i < 5000; ++i) {
    const Real s = std::pow(10, dice(-100, 100));
    const SymTensor a = dice.tensor();
    diagonal.add({s * a.xx, 0, 0, s * a.yy, 0, s * a.zz});
    plane.add({s * a.xx, s * a.xy, 0, s * a.yy, 0, s * a.zz});
    plane.add({s * a.xx, 0, s * a.xz, s * a.yy, 0, s * a.zz});
    plane.add({s * a.xx, 0, 0, s * a.yy, s * a.yz, s * a.zz});
    const Vec3 v{dice(-1, 1), dice(-1, 1), dice(-1, 1)};
    rank_one.add(s * SymTensor{v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z});
  }
  diagonal.judge("diagonal");
  EXPECT_EQ(diagonal.residual, 0);
  plane.judge("plane");
  rank_one.judge("rank one");
  const Eigen zero = eigen({});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(zero.value[i], 0);
    EXPECT_EQ(norm(zero.vector[i]), 1);
  }
}

}  // namespace
}  // namespace fsi
