#include "libfsi/run/spline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace fsi {
namespace {

/// 1, s_k and s_k s_l in `dim` dimensions.
struct Terms {
  std::array<Real, 10> p{};
  int count = 0;
};

Terms terms_at(const Vec3& s, int dim) {
  Terms at;
  at.p[at.count++] = 1;
  for (int k = 0; k < dim; ++k) at.p[at.count++] = s[k];
  for (int k = 0; k < dim; ++k)
    for (int l = k; l < dim; ++l) at.p[at.count++] = s[k] * s[l];
  return at;
}

Real cube(Real r) { return r * r * r; }

/// b <- A^-1 b by elimination with the largest pivot of a column; A: m x m, destroyed.
void eliminate(std::vector<Real>& A, std::vector<Vec3>& b) {
  const std::size_t m = b.size();
  for (std::size_t c = 0; c < m; ++c) {
    std::size_t pivot = c;
    for (std::size_t i = c + 1; i < m; ++i)
      if (std::abs(A[i * m + c]) > std::abs(A[pivot * m + c])) pivot = i;
    for (std::size_t j = c; j < m; ++j) std::swap(A[c * m + j], A[pivot * m + j]);
    std::swap(b[c], b[pivot]);
    for (std::size_t i = c + 1; i < m; ++i) {
      const Real part = A[i * m + c] / A[c * m + c];
      for (std::size_t j = c; j < m; ++j) A[i * m + j] -= part * A[c * m + j];
      b[i] = b[i] - part * b[c];
    }
  }
  for (std::size_t c = m; c-- > 0;) {
    for (std::size_t j = c + 1; j < m; ++j) b[c] = b[c] - A[c * m + j] * b[j];
    b[c] = b[c] / A[c * m + c];
  }
}

}  // namespace

Spline::Spline(std::vector<Point> points, int dim)
    : points_(std::move(points)), dim_(dim), origin_(points_.front().s) {
  Real largest = 0;
  for (const Point& point : points_) largest = std::max(largest, norm(point.s - origin_));
  if (largest > 0) size_ = largest;
  for (Point& point : points_) point.s = (point.s - origin_) / size_;
  choose_terms();
  solve();
}

void Spline::choose_terms() {
  constexpr Real told = 0.02;  // of the term's norm, that is left beside those before
  const std::size_t n = points_.size();
  const int all = terms_at({}, dim_).count;
  const int count = n < static_cast<std::size_t>(all) ? 1 + dim_ : all;
  std::vector<std::vector<Real>> kept;  // orthonormal
  for (int j = 0; j < count && kept.size() < n; ++j) {
    std::vector<Real> term(n);
    for (std::size_t i = 0; i < n; ++i) term[i] = terms_at(points_[i].s, dim_).p[j];
    const auto length = [&] {
      Real sum = 0;
      for (const Real value : term) sum += value * value;
      return std::sqrt(sum);
    };
    const Real before = length();
    for (int pass = 0; pass < 2; ++pass)  // the second removes what rounding left
      for (const std::vector<Real>& other : kept) {
        Real along = 0;
        for (std::size_t i = 0; i < n; ++i) along += other[i] * term[i];
        for (std::size_t i = 0; i < n; ++i) term[i] -= along * other[i];
      }
    const Real left = length();
    if (!(left > told * before)) continue;
    for (Real& value : term) value /= left;
    kept.push_back(std::move(term));
    terms_.push_back(j);
  }
}

void Spline::solve() {
  const std::size_t n = points_.size(), m = n + terms_.size();
  std::vector<Real> A(m * m, 0);
  std::vector<Vec3> b(m);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) A[i * m + k] = cube(norm(points_[i].s - points_[k].s));
    const Terms at = terms_at(points_[i].s, dim_);
    for (std::size_t j = 0; j < terms_.size(); ++j)
      A[i * m + n + j] = A[(n + j) * m + i] = at.p[terms_[j]];
    b[i] = points_[i].u;
  }
  eliminate(A, b);
  w_.assign(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(n));
  a_.assign(b.begin() + static_cast<std::ptrdiff_t>(n), b.end());
}

Vec3 Spline::operator()(const Vec3& s) const {
  const Vec3 at = (s - origin_) / size_;
  const Terms terms = terms_at(at, dim_);
  Vec3 u;
  for (std::size_t i = 0; i < w_.size(); ++i) u += cube(norm(at - points_[i].s)) * w_[i];
  for (std::size_t j = 0; j < a_.size(); ++j) u += terms.p[terms_[j]] * a_[j];
  return u;
}

bool Spline::tells_slope() const {
  return static_cast<int>(terms_.size()) > dim_ && terms_[static_cast<std::size_t>(dim_)] == dim_;
}

}  // namespace fsi
