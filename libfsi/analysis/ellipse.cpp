#include "libfsi/analysis/ellipse.hpp"

#include <cmath>
#include <limits>

#include "libfsi/core/eigen.hpp"

namespace fsi::analysis {
namespace {

/// Row d, column j: the mean of x^(d - j) y^j.
using Means = std::array<std::array<Real, 5>, 5>;

/// Moments about (dx, dy) from moments about the origin: expands (x - dx)^i (y - dy)^j.
Means shifted(const Means& m, Real dx, Real dy) {
  constexpr std::array<std::array<Real, 5>, 5> binomial{
      {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}}};
  Means out{};
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; i + j < 5; ++j) {
      for (int a = 0; a <= i; ++a) {
        for (int b = 0; b <= j; ++b) {
          out[i + j][j] += binomial[i][a] * binomial[j][b] * std::pow(-dx, i - a) *
                           std::pow(-dy, j - b) * m[a + b][b];
        }
      }
    }
  }
  return out;
}

/// a x^2 + b x y + c y^2 + d x + e y + f = 0.
struct Conic {
  Real a, b, c, d, e, f;
};

/// Least squares of the conic's left-hand side over the points, under 4 a c - b^2 = 1, which only
/// an ellipse meets [Fitzgibbon99]. It is split into a quadratic and a linear part [Halir98]. With
/// M the quadratic moments after the best linear part is taken out,
///   M a = l C a,   C = ((0 0 2) (0 -1 0) (2 0 0)).
/// The one positive 1/l of M^(-1/2) C M^(-1/2) belongs to the ellipse. m: moments about the mean,
/// so that the first ones vanish.
Conic fitted(const Means& m) {
  const Real xx = m[2][0], xy = m[2][1], yy = m[2][2];
  const Real d = xx * yy - xy * xy;
  const Vec3 p{m[3][0], m[3][1], m[3][2]}, q{m[3][1], m[3][2], m[3][3]}, r{xx, xy, yy};
  const auto less = [&](int i, int j) {
    return (yy * p[i] * p[j] - xy * (p[i] * q[j] + q[i] * p[j]) + xx * q[i] * q[j]) / d +
           r[i] * r[j];
  };
  const SymTensor M{m[4][0] - less(0, 0), m[4][1] - less(0, 1), m[4][2] - less(0, 2),
                    m[4][2] - less(1, 1), m[4][3] - less(1, 2), m[4][4] - less(2, 2)};
  const Eigen e = eigen(M);
  // Points that lie on an ellipse make M singular: its null vector then wins by a large factor.
  constexpr Real round_off = 1e-15;
  std::array<Vec3, 3> w;
  for (std::size_t k = 0; k < 3; ++k) {
    w[k] = e.vector[k] / std::sqrt(std::max(e.value[k], round_off * e.value[2]));
  }
  const auto c = [](const Vec3& u, const Vec3& v) {
    return 2 * (u.x * v.z + u.z * v.x) - u.y * v.y;
  };
  const Eigen best = eigen(
      {c(w[0], w[0]), c(w[0], w[1]), c(w[0], w[2]), c(w[1], w[1]), c(w[1], w[2]), c(w[2], w[2])});
  const Vec3 y = best.vector[2];
  const Vec3 a = y.x * w[0] + y.y * w[1] + y.z * w[2];
  const Real pa = dot(p, a), qa = dot(q, a);
  return {a.x, a.y, a.z, -(yy * pa - xy * qa) / d, -(xx * qa - xy * pa) / d, -dot(r, a)};
}

Ellipse geometry_of(const Conic& k) {
  // (x - c)^T Q (x - c) = -rest, Q = ((a b/2) (b/2 c)).
  const Real d = k.a * k.c - k.b * k.b / 4;
  Ellipse e;
  e.x = -(k.c * k.d - k.b / 2 * k.e) / (2 * d);
  e.y = -(k.a * k.e - k.b / 2 * k.d) / (2 * d);
  const Real rest = k.f + (k.d * e.x + k.e * e.y) / 2;
  const Real sign = k.a + k.c > 0 ? 1 : -1;
  const Real mean = sign * (k.a + k.c) / 2, half = std::hypot((k.a - k.c) / 2, k.b / 2);
  e.major = std::sqrt(-sign * rest / (mean - half));
  e.minor = std::sqrt(-sign * rest / (mean + half));
  // Q has its larger eigenvalue along the minor axis.
  e.angle = std::atan2(-sign * k.b, sign * (k.c - k.a)) / 2;
  e.found = d > 0 && std::isfinite(e.major) && e.minor > 0;
  return e;
}

}  // namespace

void PlaneMoments::add(Real x, Real y, Real weight) {
  std::size_t i = 0;
  for (int degree = 0; degree < 5; ++degree) {
    for (int j = 0; j <= degree; ++j) {
      Real term = weight;
      for (int k = 0; k < degree; ++k) term *= k < degree - j ? x : y;
      sums_[i++].add(term);
    }
  }
}

Ellipse PlaneMoments::solve(const std::array<Real, count>& moments) {
  if (!(moments[0] > 0)) return {};
  Means m{};
  std::size_t i = 0;
  for (int degree = 0; degree < 5; ++degree) {
    for (int j = 0; j <= degree; ++j) m[degree][j] = moments[i++] / moments[0];
  }
  const Real x = m[1][0], y = m[1][1];
  m = shifted(m, x, y);
  const Real scale = std::sqrt(m[2][0] + m[2][2]);
  Real power = 1;
  for (auto& row : m) {
    for (Real& item : row) item /= power;
    power *= scale;
  }
  constexpr Real on_a_line = 1e-12;
  if (!(m[2][0] * m[2][2] - m[2][1] * m[2][1] > on_a_line)) return {};
  Ellipse e = geometry_of(fitted(m));
  if (!e.found) return {};
  e.x = x + scale * e.x, e.y = y + scale * e.y;
  e.major *= scale, e.minor *= scale;
  return e;
}

}  // namespace fsi::analysis
