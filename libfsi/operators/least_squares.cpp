#include "libfsi/operators/least_squares.hpp"

#include <cmath>

#include "libfsi/operators/stencil.hpp"

namespace fsi {
namespace {

Real mean_eigenvalue(const SymTensor& M, int dim) {
  return dim == 2 ? (M.xx + M.yy) / 2 : trace(M) / 3;
}

}  // namespace

bool tells(const SymTensor& M, int dim, Real part) {
  const Real mean = mean_eigenvalue(M, dim);
  const Real whole = dim == 2 ? M.xx * M.yy - M.xy * M.xy : det(M);
  return whole > part * (dim == 2 ? mean * mean : mean * mean * mean);
}

SymTensor pseudo_inverse(const SymTensor& M, Real part) {
  SymTensor sum;
  for_told_directions(M, part, [&](Real by, const Vec3& e) { sum += by * square(e); });
  return sum;
}

SymTensor raised_inverse(SymTensor M, int dim) {
  constexpr Real told = 1e-3;
  const Real more = tells(M, dim, told) ? 0 : 1e-2 * mean_eigenvalue(M, dim);
  if (dim == 2) M.zz = 1;
  if (more > 0) M.xx += more, M.yy += more, M.zz += more;
  return inverse(M);
}

SymTensor inverse_moments(const Mesh& mesh, Index c, const SymmetryFaces& symmetry) {
  constexpr Real flat = 1e-6;
  SymTensor M;
  for_neighbours_and_images(c, symmetry, mesh, [&](Index, const Vec3& r, const Reflection& /*n*/) {
    M += (1 / norm2(r)) * square(r);
  });
  const bool told = tells(M, mesh.dim, flat);
  if (mesh.dim == 2) M.zz = 0.5 * trace(M);  // any value, since no vector has a part along z
  return told ? inverse(M) : pseudo_inverse(M, flat);
}

Vec3 slope_at(const CellField<Real>& q, const SymTensor& inverse, const Mesh& mesh, Index c,
              const SymmetryFaces& symmetry) {
  Vec3 sum;
  for_neighbours_and_images(c, symmetry, mesh,
                            [&](Index k, const Vec3& r, const Reflection& /*n*/) {
                              sum += ((q[k] - q[c]) / norm2(r)) * r;
                            });
  return dot(inverse, sum);
}

Tensor slope_at(const CellField<Vec3>& u, const SymTensor& inverse, const Mesh& mesh, Index c,
                const SymmetryFaces& symmetry) {
  Tensor sum;
  for_neighbours_and_images(c, symmetry, mesh, [&](Index k, const Vec3& r, const Reflection& n) {
    sum += outer(image(u[k], n) - u[c], r / norm2(r));
  });
  return dot(sum, inverse);
}

void QuadraticFit::add_value(const Vec3& r, const Vec3& du) {
  const Vec3 s = r / size_;
  const Real xx = s.x * s.x / 2, yy = s.y * s.y / 2, zz = s.z * s.z / 2;
  if (dim_ == 2)
    add({s.x, s.y, xx, s.x * s.y, yy}, du, 1 / norm2(s));
  else
    add({s.x, s.y, s.z, xx, yy, zz, s.x * s.y, s.x * s.z, s.y * s.z}, du, 1 / norm2(s));
}

void QuadraticFit::add_gradient(const Vec3& r, const Tensor& L) {
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

std::optional<Tensor> QuadraticFit::gradient() {
  // With 20 or 20 2/3, as on meshes of equal right triangles, rounding would decide.
  constexpr Real variance_max = 20.3;
  if (!factorise()) return {};
  Real sum = 0;  // does not depend on the axes
  for (int i = 0; i < dim_; ++i) sum += variance(i);
  if (!(sum <= variance_max)) return {};
  solve();
  const auto column = [&](int i) { return (1 / size_) * b_[i]; };
  const Vec3 x = column(0), y = column(1), z = dim_ == 3 ? column(2) : Vec3{};
  return Tensor{x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z};
}

void QuadraticFit::add(const Row& row, const Vec3& rhs, Real w) {
  for (int i = 0; i < n_; ++i) {
    for (int j = i; j < n_; ++j) A_[i][j] += w * row[i] * row[j];
    b_[i] += (w * row[i]) * rhs;
  }
}

bool QuadraticFit::factorise() {
  constexpr Real flat = 1e-9;  // part of a diagonal entry below which the matrix is singular
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

Real QuadraticFit::variance(int i) const {
  std::array<Real, 9> x{};
  Real sum = 0;
  for (int j = i; j < n_; ++j) {
    x[j] = i == j ? 1 : 0;
    for (int k = i; k < j; ++k) x[j] -= A_[k][j] * x[k];
    sum += x[j] * x[j] / A_[j][j];
  }
  return sum;
}

void QuadraticFit::solve() {
  for (int i = 0; i < n_; ++i) {
    for (int k = 0; k < i; ++k) b_[i] += -A_[k][i] * b_[k];
  }
  for (int i = n_ - 1; i >= 0; --i) {
    b_[i] *= 1 / A_[i][i];
    for (int k = i + 1; k < n_; ++k) b_[i] += -A_[i][k] * b_[k];
  }
}

}  // namespace fsi
