#include "libfsi/geometry/moments.hpp"

#include <array>

namespace fsi::geometry {
namespace {

/// Adds the simplex of the origin and n = dim points, with its sign:
///   V = det(x_1 .. x_n) / n!,   integral of x = V / (n + 1) sum x_i,
///   integral of x x = V / ((n + 1) (n + 2)) (sum x_i x_i + (sum x_i) (sum x_i)).
template <std::size_t n>
void add(Moments& m, const std::array<Vec3, n>& x) {
  Real volume = 0;
  if constexpr (n == 2) {
    volume = (x[0].x * x[1].y - x[0].y * x[1].x) / 2;
  } else {
    volume = dot(x[0], cross(x[1], x[2])) / 6;
  }
  Vec3 sum;
  SymTensor squares;
  for (const Vec3& corner : x) sum += corner, squares += square(corner);
  constexpr Real d = n;
  m.volume += volume;
  m.first += volume / (d + 1) * sum;
  m.second += volume / ((d + 1) * (d + 2)) * (squares + square(sum));
}

void add_fan(Moments& m, int dim, std::span<const Vec3> x) {
  if (dim == 2) {
    if (x.size() == 2) add<2>(m, {x[0], x[1]});
    return;
  }
  for (std::size_t i = 2; i < x.size(); ++i) add<3>(m, {x[0], x[i - 1], x[i]});
}

}  // namespace

Moments shifted(const Moments& m, const Vec3& shift) {
  Moments out = m;
  out.first += m.volume * shift;
  out.second += m.volume * square(shift);
  out.second += both_ways(m.first, shift);
  return out;
}

// About a point of the mirror x' = R x, R = I - 2 n n, so the second moments become R S R.
Moments image(const Moments& m, const Mirror& mirror) {
  const Moments at = shifted(m, -mirror.x);
  const Vec3 x = mirror.of_direction({1, 0, 0}), y = mirror.of_direction({0, 1, 0}),
             z = mirror.of_direction({0, 0, 1});
  const Vec3 Sx = dot(at.second, x), Sy = dot(at.second, y), Sz = dot(at.second, z);
  const Moments turned{at.volume,
                       mirror.of_direction(at.first),
                       {dot(x, Sx), dot(x, Sy), dot(x, Sz), dot(y, Sy), dot(y, Sz), dot(z, Sz)}};
  return shifted(turned, mirror.x);
}

Moments moments(const Polytope& cell) {
  Moments m;
  const auto x = cell.points();
  for (const Polytope::Facet& f : cell.facets()) {
    const std::array<Vec3, 3> corners{x[f[0]], x[f[1]], x[f[2]]};
    add_fan(m, cell.dim(), std::span(corners).first(static_cast<std::size_t>(cell.dim())));
  }
  return m;
}

// With the origin in the plane, the simplices of the origin and the cut have no volume: the clipped
// facets of the cell are enough.
Moments moments_below(const Polytope& cell, const Plane& plane) {
  Moments m;
  const auto x = cell.points();
  const Vec3 origin = plane.s * plane.n;
  const int corners = cell.dim();
  for (const Polytope::Facet& f : cell.facets()) {
    std::array<Vec3, 4> kept;
    std::size_t n = 0;
    for (int i = 0; i < corners; ++i) {
      const Vec3 a = x[f[i]] - origin, b = x[f[(i + 1) % corners]] - origin;
      const Real qa = dot(plane.n, a), qb = dot(plane.n, b);
      if (qa < 0) kept[n++] = a;
      if (i == 1 && corners == 2) break;  // an edge has no way back
      if ((qa < 0) != (qb < 0)) kept[n++] = a + qa / (qa - qb) * (b - a);
    }
    add_fan(m, corners, std::span(kept).first(n));
  }
  return shifted(m, origin);
}

}  // namespace fsi::geometry
