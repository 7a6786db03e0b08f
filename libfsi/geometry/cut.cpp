#include "libfsi/geometry/cut.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "libfsi/core/error.hpp"

namespace fsi::geometry {
namespace {

/// Mean of (t / d)^2 over t from a to b, all in [0, d].
Real mean_square(Real a, Real b, Real d) {
  const Real p = a / d, r = b / d;
  return (p * p + p * r + r * r) / 3;
}

/// The part of [a, b] within [low, high], weighted: mean(from, to) is the mean over that part.
template <class Mean>
Real share(Real a, Real b, Real low, Real high, const Mean& mean) {
  const Real from = std::max(a, low), to = std::min(b, high);
  return from < to ? (to - from) * mean(from, to) : 0;
}

template <std::size_t n>
Levels<n> sorted(Levels<n> q) {
  if (q[1] < q[0]) std::swap(q[0], q[1]);
  if constexpr (n == 3) {
    if (q[2] < q[1]) std::swap(q[1], q[2]);
    if (q[1] < q[0]) std::swap(q[0], q[1]);
  }
  return q;
}

/// S of a facet: the area vector (2-D: length times the outward normal).
template <int dim>
Vec3 facet_area(std::span<const Vec3> x, const Polytope::Facet& f) {
  const Vec3 a = x[f[1]] - x[f[0]];
  if constexpr (dim == 2) return {a.y, -a.x, 0};
  return 0.5 * cross(a, x[f[2]] - x[f[0]]);
}

/// A cell along a direction n: the parts of the volume below a level.
template <int dim>
struct Profile {
  struct Item {
    Levels<dim> q;
    Real xS, nS;
  };
  int n_items = 0;
  Real whole = 0;                                            // volume
  Real low = std::numeric_limits<Real>::max(), high = -low;  // levels of the corners
  std::array<Item, Polytope::max_facets> items;

  Profile(const Polytope& cell, const Vec3& n) {
    const auto x = cell.points();
    std::array<Real, Polytope::max_points> level;
    for (std::size_t i = 0; i < x.size(); ++i) {
      level[i] = dot(n, x[i]);
      low = std::min(low, level[i]), high = std::max(high, level[i]);
    }
    for (const Polytope::Facet& f : cell.facets()) {
      const Vec3 S = facet_area<dim>(x, f);
      Levels<dim> q;
      for (std::size_t i = 0; i < dim; ++i) q[i] = level[f[i]];
      items[n_items++] = {sorted(q), dot(x[f[0]], S), dot(n, S)};
      whole += dot(x[f[0]], S) / dim;
    }
  }

  /// By Gauss's theorem, with the parts a_f of the facets below the level s:
  ///   V(s) = (1/dim) sum_f a_f (x - s n) . S,   dV/ds = A(s) = -sum_f a_f n . S
  Below below(Real s) const {
    Real volume = 0, area = 0;
    for (int i = 0; i < n_items; ++i) {
      const Real part = part_below(items[i].q, s);
      volume += part * (items[i].xS - s * items[i].nS);
      area -= part * items[i].nS;
    }
    return {volume / dim, area};
  }
};

/// The level with V(s) = fraction V, by Newton's method within a bracket. In a convex cell
/// V^(1/dim) is a concave function of s (Brunn and Minkowski). So the root lies between
/// fraction / dim and fraction^(1/dim) of the way from the lowest corner to the highest one.
template <int dim>
Plane plane_of(const Polytope& cell, const Vec3& n, Real fraction) {
  constexpr int rounds = 80;      // five or six do in a convex cell
  constexpr Real nearly = 1e-13;  // of the volume: the next step ends at round-off
  const Profile<dim> profile(cell, n);
  Real low = profile.low, high = profile.high;
  const Real most = dim == 2 ? std::sqrt(fraction) : std::cbrt(fraction);
  Real s = low + (high - low) * (fraction / dim + most) / 2;
  for (int i = 0; i < rounds; ++i) {
    const Below at = profile.below(s);
    const Real off = at.measure - fraction * profile.whole;
    (off < 0 ? low : high) = s;
    const Real next = s - off / at.area;
    const bool inside = next > low && next < high, last = std::abs(off) <= nearly * profile.whole;
    if (inside || !last) s = inside ? next : (low + high) / 2;
    if (last) break;
  }
  return {n, s};
}

/// Where the edge from a to b passes level s; qa and qb lie on different sides.
Vec3 passing(const Vec3& a, const Vec3& b, Real qa, Real qb, Real s) {
  return a + (s - qa) / (qb - qa) * (b - a);
}

/// 3-D: area = |sum (p - o) x (r - o)| / 2 over the segments (p, r) in which facets are cut, o any
/// point of the plane. On a walk around an outward facet, r is where the walk leaves the part
/// below.
Cut cut_polyhedron(const Polytope& cell, const Plane& plane) {
  const auto x = cell.points();
  std::array<Real, Polytope::max_points> q;
  for (std::size_t i = 0; i < x.size(); ++i) q[i] = dot(plane.n, x[i]);
  bool started = false;
  Vec3 origin, moment;
  SymTensor second;
  Real twice = 0;
  for (const Polytope::Facet& f : cell.facets()) {
    const int below = (q[f[0]] < plane.s) + (q[f[1]] < plane.s) + (q[f[2]] < plane.s);
    if (below == 0 || below == 3) continue;
    Vec3 enter, leave;
    for (int i = 0; i < 3; ++i) {
      const auto a = f[i], b = f[(i + 1) % 3];
      if ((q[a] < plane.s) == (q[b] < plane.s)) continue;
      (q[a] < plane.s ? leave : enter) = passing(x[a], x[b], q[a], q[b], plane.s);
    }
    if (!started) origin = enter, started = true;
    const Vec3 p = enter - origin, r = leave - origin;
    const Real area = dot(plane.n, cross(p, r));
    twice += area;
    moment += area * (p + r);
    second += area * (square(p) + square(r) + square(p + r));
  }
  if (!(twice > 0)) return {};
  const Vec3 centre = moment / (3 * twice);
  return {twice / 2, origin + centre, 1 / (12 * twice) * second - square(centre)};
}

/// 2-D: along the tangent t of the cut, length = sum of t where edges lead into the part below less
/// the sum where they lead out of it.
Cut cut_polygon(const Polytope& cell, const Plane& plane) {
  const auto x = cell.points();
  const Vec3 tangent{-plane.n.y, plane.n.x, 0};
  Real length = 0, moment = 0;
  for (const Polytope::Facet& f : cell.facets()) {
    const Vec3 &a = x[f[0]], &b = x[f[1]];
    const Real qa = dot(plane.n, a), qb = dot(plane.n, b);
    if ((qa < plane.s) == (qb < plane.s)) continue;
    const Real t = dot(tangent, passing(a, b, qa, qb, plane.s));
    const Real sign = qa < plane.s ? -1 : 1;
    length += sign * t;
    moment += sign * t * t / 2;
  }
  if (!(length > 0)) return {};
  return {length, plane.s * plane.n + moment / length * tangent,
          length * length / 12 * square(tangent)};
}

}  // namespace

Real mean_part_below(const Levels<2>& q, Real s0, Real s1) {
  const Real a = std::min(s0, s1), b = std::max(s0, s1);
  if (!(a < b)) return part_below(q, s0);
  const Real rising = share(a, b, q[0], q[1], [&](Real from, Real to) {
    return ((from - q[0]) / (q[1] - q[0]) + (to - q[0]) / (q[1] - q[0])) / 2;
  });
  const Real full = share(a, b, q[1], b, [](Real, Real) { return Real{1}; });
  return std::min(Real{1}, (rising + full) / (b - a));
}

Real mean_part_below(const Levels<3>& q, Real s0, Real s1) {
  const Real a = std::min(s0, s1), b = std::max(s0, s1);
  if (!(a < b)) return part_below(q, s0);
  const Real first = share(a, b, q[0], q[1], [&](Real from, Real to) {
    const Real d = q[1] - q[0];
    return mean_square(from - q[0], to - q[0], d) * (d / (q[2] - q[0]));
  });
  const Real second = share(a, b, q[1], q[2], [&](Real from, Real to) {
    const Real d = q[2] - q[1];
    return 1 - mean_square(q[2] - to, q[2] - from, d) * (d / (q[2] - q[0]));
  });
  const Real full = share(a, b, q[2], b, [](Real, Real) { return Real{1}; });
  return std::min(Real{1}, (first + second + full) / (b - a));
}

void Polytope::add_face(std::span<const Vec3> corners, bool reversed) {
  const int n = static_cast<int>(corners.size());
  const bool fan = n > 3;
  if (n_points_ + n + (fan ? 1 : 0) > max_points || n_facets_ + (fan ? n : 1) > max_facets) {
    throw Error(ErrorKind::internal, "geometry::Polytope: more than " + std::to_string(max_facets) +
                                         " facets in a cell");
  }
  const int first = n_points_;
  const auto corner = [&](int i) {
    return static_cast<std::uint8_t>(first + (reversed ? n - 1 - i % n : i % n));
  };
  Vec3 sum;
  for (const Vec3& x : corners) points_[n_points_++] = x, sum += x;
  if (!fan) {
    facets_[n_facets_++] = {corner(0), corner(1), corner(2)};
    return;
  }
  const auto centre = static_cast<std::uint8_t>(n_points_);
  points_[n_points_++] = sum / n;
  for (int i = 0; i < n; ++i) facets_[n_facets_++] = {centre, corner(i), corner(i + 1)};
}

Real measure(const Polytope& cell) {
  const auto x = cell.points();
  Real sum = 0;
  for (const Polytope::Facet& f : cell.facets()) {
    sum += dot(x[f[0]], cell.dim() == 2 ? facet_area<2>(x, f) : facet_area<3>(x, f));
  }
  return sum / cell.dim();
}

Below below(const Polytope& cell, const Plane& plane) {
  return cell.dim() == 2 ? Profile<2>(cell, plane.n).below(plane.s)
                         : Profile<3>(cell, plane.n).below(plane.s);
}

Real measure_below(const Polytope& cell, const Plane& plane) { return below(cell, plane).measure; }

Plane plane_at(const Polytope& cell, const Vec3& n, Real fraction) {
  const bool flip = fraction > 0.5;  // the smaller part has the smaller error
  const Vec3 along = flip ? -n : n;
  const Real part = flip ? 1 - fraction : fraction;
  const Plane plane =
      cell.dim() == 2 ? plane_of<2>(cell, along, part) : plane_of<3>(cell, along, part);
  return {n, flip ? -plane.s : plane.s};
}

Cut cut(const Polytope& cell, const Plane& plane) {
  return cell.dim() == 2 ? cut_polygon(cell, plane) : cut_polyhedron(cell, plane);
}

}  // namespace fsi::geometry
