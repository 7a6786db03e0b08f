#pragma once
// Least-squares fit of a quadratic velocity about a cell.

#include <array>
#include <optional>

#include "libfsi/core/types.hpp"

namespace fsi::solid {

/// u(x_c + r) = u_c + L . r + (1/2) r . H . r from values u_k and gradients L_k around the cell:
///   min over L, H of  sum_k w |u_c + L . r + r . H . r / 2 - u_k|^2 + sum_k |L + H . r - L_k|^2,
/// w = 1 / |r|^2. Exact for a quadratic velocity on any mesh.
class QuadraticFit {
 public:
  /// size: a length of the cell, by which the unknowns are scaled.
  QuadraticFit(int dim, Real size) : dim_(dim), n_(dim == 2 ? 5 : 9), size_(size) {}

  /// u_k - u_c at r.
  void add_value(const Vec3& r, const Vec3& du) {
    const Vec3 s = r / size_;
    const Real xx = s.x * s.x / 2, yy = s.y * s.y / 2, zz = s.z * s.z / 2;
    if (dim_ == 2)
      add({s.x, s.y, xx, s.x * s.y, yy}, du, 1 / norm2(s));
    else
      add({s.x, s.y, s.z, xx, yy, zz, s.x * s.y, s.x * s.z, s.y * s.z}, du, 1 / norm2(s));
  }
  /// L_k at r.
  void add_gradient(const Vec3& r, const Tensor& L) {
    const Vec3 s = r / size_;
    const Vec3 x{L.xx, L.yx, L.zx}, y{L.xy, L.yy, L.zy}, z{L.xz, L.yz, L.zz};
    if (dim_ == 2) {
      add({1, 0, s.x, s.y, 0}, size_ * x, 1);
      add({0, 1, 0, s.x, s.y}, size_ * y, 1);
      return;
    }
    add({1, 0, 0, s.x, 0, 0, s.y, s.z, 0}, size_ * x, 1);
    add({0, 1, 0, 0, s.y, 0, s.x, 0, s.z}, size_ * y, 1);
    add({0, 0, 1, 0, 0, s.z, 0, s.x, s.y}, size_ * z, 1);
  }
  /// L, or nothing where the fit does not tell it: where independent errors e |r_k| / size of the
  /// u_k and e / size of the L_k make one of more than sqrt(20) e / size. With five values for five
  /// unknowns it can be 40, and a viscous flux that takes such an L grows from step to step. Once.
  std::optional<Tensor> gradient() {
    constexpr Real variance_max = 20;
    if (!factorise()) return {};
    for (int i = 0; i < dim_; ++i)
      if (!(variance(i) <= variance_max)) return {};
    solve();
    const auto column = [&](int i) { return (1 / size_) * b_[i]; };
    const Vec3 x = column(0), y = column(1), z = dim_ == 3 ? column(2) : Vec3{};
    return Tensor{x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
  }

 private:
  using Row = std::array<Real, 9>;

  void add(const Row& row, const Vec3& rhs, Real w) {
    for (int i = 0; i < n_; ++i) {
      for (int j = i; j < n_; ++j) A_[i][j] += w * row[i] * row[j];
      b_[i] += (w * row[i]) * rhs;
    }
  }
  /// A = R^T D R in place, R with a unit diagonal [GolubVanLoan13] 4.1; whether A is positive.
  bool factorise() {
    constexpr Real flat = 1e-9;  // part of a diagonal entry that counts as nothing left
    for (int i = 0; i < n_; ++i) {
      const Real whole = A_[i][i];
      for (int k = 0; k < i; ++k) A_[i][i] -= A_[k][i] * A_[k][i] * A_[k][k];
      if (!(A_[i][i] > flat * whole)) return false;
      for (int j = i + 1; j < n_; ++j) {
        for (int k = 0; k < i; ++k) A_[i][j] -= A_[k][i] * A_[k][j] * A_[k][k];
        A_[i][j] /= A_[i][i];
      }
    }
    return true;
  }
  /// (A^-1)_ii = |D^(-1/2) R^-T e_i|^2.
  Real variance(int i) const {
    std::array<Real, 9> x{};
    Real sum = 0;
    for (int j = i; j < n_; ++j) {
      x[j] = i == j ? 1 : 0;
      for (int k = i; k < j; ++k) x[j] -= A_[k][j] * x[k];
      sum += x[j] * x[j] / A_[j][j];
    }
    return sum;
  }
  /// b <- A^-1 b.
  void solve() {
    for (int i = 0; i < n_; ++i) {
      for (int k = 0; k < i; ++k) b_[i] += -A_[k][i] * b_[k];
    }
    for (int i = n_ - 1; i >= 0; --i) {
      b_[i] *= 1 / A_[i][i];
      for (int k = i + 1; k < n_; ++k) b_[i] += -A_[i][k] * b_[k];
    }
  }

  int dim_, n_;
  Real size_;
  std::array<Row, 9> A_{};  // upper triangle
  std::array<Vec3, 9> b_{};
};

}  // namespace fsi::solid
