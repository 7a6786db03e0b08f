#pragma once
// Slopes and quadratics by least squares over the places around a cell.
//
// The slope g of q at places r makes sum w |g . r - dq|^2 least, w = 1 / |r|^2. It is that of
//   g . M = R,   M = sum w r (x) r,   R = sum w dq (x) r.
// Where M does not tell g in all directions the user chooses: leave these out
// (`for_told_directions`, `pseudo_inverse`), let g tend to zero there (`raised_inverse`), or take
// no fit (`tells`).

#include <array>
#include <optional>

#include "libfsi/core/eigen.hpp"
#include "libfsi/field/field.hpp"

namespace fsi {

/// Whether M tells a slope in all directions, in two dimensions in the plane: whether det M is more
/// than the `part` of what it would be if M were alike in all of them.
bool tells(const SymTensor& M, int dim, Real part);

/// Calls f(1 / value, vector) for the eigenvectors of M whose value is more than the `part` of the
/// largest.
template <class Function>
void for_told_directions(const SymTensor& M, Real part, Function&& f) {
  const Eigen e = eigen(M);
  for (std::size_t i = 0; i < 3; ++i)
    if (e.value[i] > part * e.value[2]) f(1 / e.value[i], e.vector[i]);
}

/// Inverse of M in these directions, zero in the others.
SymTensor pseudo_inverse(const SymTensor& M, Real part);

/// Inverse of M, in two dimensions of its in-plane part. Where M does not tell a direction (fewer
/// places than unknowns) M is raised by a hundredth of its mean eigenvalue: the slope along that
/// direction tends to zero. M: not zero.
SymTensor raised_inverse(SymTensor M, int dim);

/// The slope of a velocity, by what it is more than a guess.
struct SlopeFit {
  /// guess_: what holds where the places tell nothing.
  explicit SlopeFit(const Tensor& guess_ = {}) : guess(guess_) {}

  /// du at r. Returns its weight w.
  Real add(const Vec3& r, const Vec3& du) {
    const Real w = 1 / norm2(r);
    M += w * square(r);
    R += outer(w * (du - dot(guess, r)), r);
    return w;
  }
  /// du = (L + L_k) / 2 . r, the rule of the middle, where the slope L_k at r is known: exact for a
  /// quadratic u.
  Real add_pair(const Vec3& r, const Vec3& du, const Tensor& L_k) {
    return add(r, 2 * du - dot(L_k, r));
  }
  /// L; in directions that M does not tell, those with `part` of the largest eigenvalue or less,
  /// the guess.
  Tensor slope(Real part) const {
    Tensor L = guess;
    for_told_directions(M, part, [&](Real by, const Vec3& e) { L += outer(by * dot(R, e), e); });
    return L;
  }

  Tensor guess;  ///< as it was made with
  SymTensor M;   ///< sum of w r r
  Tensor R;      ///< of what du is more than guess . r
};

/// Inverse of M over the vertex neighbours of owned cell c. On directions in which these do not
/// spread (a corner cell, a layer one cell thick) it is the pseudo-inverse, so that the slope there
/// is zero.
SymTensor inverse_moments(const Mesh& mesh, Index c);

/// grad q = M^-1 sum w r (q_k - q_c) over the vertex neighbours of owned cell c, exact for linear
/// q. inverse: of `inverse_moments`. q: the neighbours' values set.
Vec3 slope_at(const CellField<Real>& q, const SymTensor& inverse, const Mesh& mesh, Index c);
/// L_ij = d u_i / d x_j.
Tensor slope_at(const CellField<Vec3>& u, const SymTensor& inverse, const Mesh& mesh, Index c);

/// A quadratic velocity u(x_c + r) = u_c + L . r + (1/2) r . H . r from values u_k and gradients
/// L_k around the cell:
///   min over L, H of  sum_k w |u_c + L . r + r . H . r / 2 - u_k|^2 + sum_k |L + H . r - L_k|^2,
/// w = 1 / |r|^2. Exact for a quadratic velocity on any mesh.
class QuadraticFit {
 public:
  /// size: a length of the cell, by which the unknowns are scaled.
  QuadraticFit(int dim, Real size) : dim_(dim), n_(dim == 2 ? 5 : 9), size_(size) {}

  /// u_k - u_c at r.
  void add_value(const Vec3& r, const Vec3& du);
  /// L_k at r.
  void add_gradient(const Vec3& r, const Tensor& L);
  /// L, or nothing where the fit does not tell it: where independent errors e |r_k| / size of the
  /// u_k and e / size of the L_k make one of more than sqrt(20) e / size. With five values for five
  /// unknowns it can be 40, and a viscous flux that takes such an L grows from step to step. Once.
  std::optional<Tensor> gradient();

 private:
  using Row = std::array<Real, 9>;

  void add(const Row& row, const Vec3& rhs, Real w);
  /// A = R^T D R in place, R with a unit diagonal [GolubVanLoan13] 4.1; whether A is positive.
  bool factorise();
  /// (A^-1)_ii = |D^(-1/2) R^-T e_i|^2.
  Real variance(int i) const;
  /// b <- A^-1 b.
  void solve();

  int dim_, n_;
  Real size_;
  std::array<Row, 9> A_{};  // upper triangle
  std::array<Vec3, 9> b_{};
};

}  // namespace fsi
