#include "libfsi/geometry/simplex.hpp"

#include <algorithm>
#include <utility>

namespace fsi::geometry {
namespace {

/// Corners ordered by sign, the negative ones first.
template <std::size_t n>
struct Signs {
  std::size_t negative = 0;
  std::array<std::size_t, n> corner{};

  explicit Signs(const std::array<Real, n>& value) {
    for (std::size_t i = 0; i < n; ++i) {
      if (value[i] < 0) corner[negative++] = i;
    }
    for (std::size_t i = 0, k = negative; i < n; ++i) {
      if (!(value[i] < 0)) corner[k++] = i;
    }
  }
};

/// Zero crossing of the edge from a negative corner a to a positive one b: s in (0, 1].
template <std::size_t n>
Crossing crossing(const std::array<Real, n>& value, std::size_t a, std::size_t b) {
  return {a, b, value[a] / (value[a] - value[b])};
}

template <std::size_t n>
std::array<Real, n> weights(const Crossing& c) {
  std::array<Real, n> lambda{};
  lambda[c.from] = 1 - c.s, lambda[c.to] = c.s;
  return lambda;
}

template <std::size_t n>
Vec3 position(const std::array<Vec3, n>& x, const Crossing& c) {
  return (1 - c.s) * x[c.from] + c.s * x[c.to];
}

/// q = sum over edges (i, j) of 4 lambda_i lambda_j b_ij, b_ij = middle value - mean of the ends:
/// the quadratic function less the linear one, at barycentric coordinates lambda = (a + b) / 2.
template <std::size_t n, class Edges, std::size_t m>
Real bubble(const Edges& edges, const std::array<Real, m>& b, const std::array<Real, n>& la,
            const std::array<Real, n>& lb) {
  Real q = 0;
  for (std::size_t e = 0; e < m; ++e) {
    const auto [i, j] = edges[e];
    q += (la[i] + lb[i]) * (la[j] + lb[j]) * b[e];
  }
  return q;
}

template <std::size_t n, class Edges, std::size_t m>
std::array<Real, m> departures(const Edges& edges, const std::array<Real, n>& corner,
                               const std::array<Real, m>& middle) {
  std::array<Real, m> b{};
  for (std::size_t e = 0; e < m; ++e) {
    b[e] = middle[e] - (corner[edges[e][0]] + corner[edges[e][1]]) / 2;
  }
  return b;
}

}  // namespace

Section section(const std::array<Real, 3>& value) {
  const Signs<3> signs(value);
  const auto& [a, b, c] = signs.corner;
  if (signs.negative == 1) return {2, {crossing(value, a, b), crossing(value, a, c)}};
  if (signs.negative == 2) return {2, {crossing(value, a, c), crossing(value, b, c)}};
  return {};
}

Section section(const std::array<Real, 4>& value) {
  const Signs<4> signs(value);
  const auto& [a, b, c, d] = signs.corner;
  switch (signs.negative) {
    case 1:
      return {3, {crossing(value, a, b), crossing(value, a, c), crossing(value, a, d)}};
    case 2:
      return {4,
              {crossing(value, a, c), crossing(value, a, d), crossing(value, b, d),
               crossing(value, b, c)}};
    case 3:
      return {3, {crossing(value, a, d), crossing(value, b, d), crossing(value, c, d)}};
    default:
      return {};
  }
}

Real negative_fraction(const std::array<Real, 3>& value) {
  const Signs<3> signs(value);
  if (signs.negative == 0 || signs.negative == 3) return signs.negative == 0 ? 0 : 1;
  const Section cut = section(value);
  const Real s = cut.at[0].s, t = cut.at[1].s;
  // One negative corner a cuts off s t; two leave the positive corner (1 - s)(1 - t).
  return signs.negative == 1 ? s * t : s + t * (1 - s);
}

Real negative_fraction(const std::array<Real, 4>& value) {
  const Signs<4> signs(value);
  if (signs.negative == 0 || signs.negative == 4) return signs.negative == 0 ? 0 : 1;
  const Section cut = section(value);
  const Real p = cut.at[0].s, q = cut.at[1].s, r = cut.at[2].s, s = cut.at[3].s;
  if (signs.negative == 1) return p * q * r;
  if (signs.negative == 3) return p + (1 - p) * (q + (1 - q) * r);  // 1 - (1 - p)(1 - q)(1 - r)
  // Wedge (a, ac, ad; b, bc, bd) as the tetrahedra (a, ac, ad, bd), (a, ac, bc, bd), (a, b, bc,
  // bd), with p, q, r, s on the edges ac, ad, bd, bc.
  return p * q * (1 - r) + p * r * (1 - s) + r * s;
}

Real negative_measure(const Triangle& x, const std::array<Real, 3>& corner,
                      const std::array<Real, 3>& middle) {
  const Real whole = measure(x), linear = whole * negative_fraction(corner);
  const Section cut = section(corner);
  if (cut.n == 0 || whole == 0) return linear;
  // |grad phi| from 2 A grad phi = n x sum phi_i (x_k - x_j), (i, j, k) cyclic.
  const Vec3 g = corner[0] * (x[2] - x[1]) + corner[1] * (x[0] - x[2]) + corner[2] * (x[1] - x[0]);
  const Real slope = norm(g) / (2 * whole);
  if (slope == 0) return linear;
  const auto b = departures(triangle_edges, corner, middle);
  const auto l0 = weights<3>(cut.at[0]), l1 = weights<3>(cut.at[1]);
  // Simpson's rule along the segment is exact for the quadratic q.
  const Real mean = (bubble(triangle_edges, b, l0, l0) + 4 * bubble(triangle_edges, b, l0, l1) +
                     bubble(triangle_edges, b, l1, l1)) /
                    6;
  const Real length = norm(position(x, cut.at[1]) - position(x, cut.at[0]));
  return std::clamp(linear - length * mean / slope, Real{0}, whole);
}

Real negative_measure(const Tetrahedron& x, const std::array<Real, 4>& corner,
                      const std::array<Real, 6>& middle) {
  const Real whole = measure(x), linear = whole * negative_fraction(corner);
  const Section cut = section(corner);
  if (cut.n == 0 || whole == 0) return linear;
  // 6 V grad phi = sum (phi_i - phi_0) e_j x e_k, e_i = x_i - x_0, (i, j, k) cyclic.
  const Vec3 e1 = x[1] - x[0], e2 = x[2] - x[0], e3 = x[3] - x[0];
  const Vec3 g = (corner[1] - corner[0]) * cross(e2, e3) + (corner[2] - corner[0]) * cross(e3, e1) +
                 (corner[3] - corner[0]) * cross(e1, e2);
  const Real slope = norm(g) / (6 * whole);
  if (slope == 0) return linear;
  const auto b = departures(tetrahedron_edges, corner, middle);
  Real integral = 0;
  const auto l0 = weights<4>(cut.at[0]);
  const Vec3 p0 = position(x, cut.at[0]);
  for (std::size_t k = 2; k < static_cast<std::size_t>(cut.n); ++k) {
    const auto l1 = weights<4>(cut.at[k - 1]), l2 = weights<4>(cut.at[k]);
    // The rule of the three edge middles is exact for the quadratic q.
    const Real mean = (bubble(tetrahedron_edges, b, l0, l1) + bubble(tetrahedron_edges, b, l1, l2) +
                       bubble(tetrahedron_edges, b, l2, l0)) /
                      3;
    integral += mean * measure(Triangle{p0, position(x, cut.at[k - 1]), position(x, cut.at[k])});
  }
  return std::clamp(linear - integral / slope, Real{0}, whole);
}

}  // namespace fsi::geometry
