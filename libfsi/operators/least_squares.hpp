#pragma once
// Slopes and quadratics by least-squares fits to values around a cell.
//
// The slope g of q minimises sum w |g . r - dq|^2, w = 1 / |r|^2, for the rises dq over the vectors
// r. It solves
//   g . M = R,   M = sum w r (x) r,   R = sum w dq (x) r.
// If the vectors r do not span all directions, the caller has three choices. It can leave
// directions out (`for_told_directions`, `pseudo_inverse`), let g tend to zero in them
// (`raised_inverse`), or make no fit (`tells`).

#include <array>
#include <optional>

#include "libfsi/core/eigen.hpp"
#include "libfsi/field/field.hpp"
#include "libfsi/operators/symmetry_faces.hpp"

namespace fsi {

/// Whether M determines a slope in all directions, in two dimensions in the plane: whether det M is
/// more than `part` of the determinant of an isotropic M with the same trace.
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

/// Inverse of M, in two dimensions of its in-plane part. If M does not determine the slope in a
/// direction (fewer values than unknowns), M is raised by a hundredth of its mean eigenvalue, and
/// the slope in that direction tends to zero. M: not zero.
SymTensor raised_inverse(SymTensor M, int dim);

/// The slope of a velocity, as a guess and a fitted correction.
struct SlopeFit {
  /// guess_: the slope in directions that the fit does not determine.
  explicit SlopeFit(const Tensor& guess_ = {}) : guess(guess_) {}

  /// Adds the rise du over r. Returns its weight w.
  Real add(const Vec3& r, const Vec3& du) {
    const Real w = 1 / norm2(r);
    M += w * square(r);
    R += outer(w * (du - dot(guess, r)), r);
    return w;
  }
  /// Adds du = (L + L_k) / 2 . r, the trapezoidal rule with a given slope L_k at r. It is exact for
  /// a quadratic u.
  Real add_pair(const Vec3& r, const Vec3& du, const Tensor& L_k) {
    return add(r, 2 * du - dot(L_k, r));
  }
  /// L. In directions whose eigenvalue of M is at most `part` of the largest one, L is the guess.
  Tensor slope(Real part) const {
    Tensor L = guess;
    for_told_directions(M, part, [&](Real by, const Vec3& e) { L += outer(by * dot(R, e), e); });
    return L;
  }

  Tensor guess;  ///< as given
  SymTensor M;   ///< sum of w r r
  Tensor R;      ///< sum of w (du - guess . r) r
};

/// Inverse of M over the vertex neighbours of owned cell c and the images in planes of symmetry
/// (`for_images`). In directions that these do not span (in a corner cell, or a layer one cell
/// thick) it is the pseudo-inverse, so that the slope there is zero.
SymTensor inverse_moments(const Mesh& mesh, Index c, const SymmetryFaces& symmetry = {});

/// grad q = M^-1 sum w r (q_k - q_c) over the same cells and images, exact for linear q. inverse:
/// of `inverse_moments` with the same planes. q: the neighbours' values set.
Vec3 slope_at(const CellField<Real>& q, const SymTensor& inverse, const Mesh& mesh, Index c,
              const SymmetryFaces& symmetry = {});
/// L_ij = d u_i / d x_j.
Tensor slope_at(const CellField<Vec3>& u, const SymTensor& inverse, const Mesh& mesh, Index c,
                const SymmetryFaces& symmetry = {});

/// A quadratic velocity u(x_c + r) = u_c + L . r + (1/2) r . H . r, fitted to values u_k and
/// gradients L_k around the cell:
///   min over L, H of  sum_k w |u_c + L . r + r . H . r / 2 - u_k|^2 + sum_k |L + H . r - L_k|^2,
/// w = 1 / |r|^2. It is exact for a quadratic velocity on any mesh.
class QuadraticFit {
 public:
  /// size: a length of the cell, by which the unknowns are scaled.
  QuadraticFit(int dim, Real size) : dim_(dim), n_(dim == 2 ? 5 : 9), size_(size) {}

  /// Adds the rise du = u_k - u_c over r.
  void add_value(const Vec3& r, const Vec3& du);
  /// Adds the gradient L_k at r.
  void add_gradient(const Vec3& r, const Tensor& L);
  /// L, or nothing if the fit amplifies errors too much. Independent errors e |r_k| / size of the
  /// u_k and e / size of the L_k may cause an error of L of at most sqrt(20.3) e / size. With
  /// five values for five unknowns 20 can become 40, and a viscous flux with such an L grows from
  /// step to step. Call it once.
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
