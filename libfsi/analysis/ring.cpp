#include "libfsi/analysis/ring.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "libfsi/core/parallel.hpp"
#include "libfsi/shapes/shapes.hpp"

namespace fsi::analysis {
namespace {

constexpr Real pi = shapes::pi;

Vec3 unit_across(const Vec3& v, const Vec3& n) {
  const Vec3 across = v - dot(v, n) * n;
  return across / norm(across);
}

/// Half planes around the axis; multiples of a quarter of their number hold zeta, eta and
/// opposites.
constexpr int n_azimuths = 64;
constexpr int quarter = n_azimuths / 4;

/// A point of the surface in a half plane that the axis bounds.
struct Point {
  Real rho, xi;
};

/// Calls visit(azimuth, a, b) for every half plane that cuts the triangle (q: along zeta, eta, xi),
/// a and b the ends of the cut. The axis must not pass through the triangle.
template <class Visit>
void cut(const std::array<Vec3, 3>& q, const Visit& visit) {
  const Real first = std::atan2(q[0].y, q[0].x);
  Real low = 0, high = 0;  // azimuths of the others from that of the first
  for (std::size_t i = 1; i < 3; ++i) {
    const Real turn =
        std::atan2(q[0].x * q[i].y - q[0].y * q[i].x, q[0].x * q[i].x + q[0].y * q[i].y);
    low = std::min(low, turn), high = std::max(high, turn);
  }
  constexpr Real step = 2 * pi / n_azimuths;
  const int last = static_cast<int>(std::ceil((first + high) / step));
  for (int k = static_cast<int>(std::floor((first + low) / step)); k <= last; ++k) {
    // In a plane of symmetry of the mesh the surface has edges. Rounding must not decide their
    // side.
    constexpr Real beside = 1e-6;
    const Real c = std::cos(step * k + beside), s = std::sin(step * k + beside);
    std::array<Point, 3> ends;
    int n = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = q[i], &b = q[(i + 1) % 3];
      const Real ha = c * a.y - s * a.x, hb = c * b.y - s * b.x;  // height over the plane
      if ((ha < 0) == (hb < 0)) continue;
      const Vec3 x = a + (ha / (ha - hb)) * (b - a);
      ends[n++] = {c * x.x + s * x.y, x.z};
    }
    if (n == 2 && ends[0].rho > 0 && ends[1].rho > 0) {
      visit((k + n_azimuths) % n_azimuths, ends[0], ends[1]);
    }
  }
}

/// Signed bending angle between the directions to two opposite centres (rho, xi), degrees.
Real bending(const Ellipse& a, const Ellipse& b) {
  if (!a.found || !b.found) return 0;
  return (std::atan2(a.y, a.x) + std::atan2(b.y, b.x)) * (180 / pi);
}

/// Largest value at each azimuth over all ranks.
void largest_of_ranks(std::array<Real, 2 * n_azimuths>& values) {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), 2 * n_azimuths, MPI_DOUBLE, MPI_MAX, comm());
}

std::array<Ellipse, 2> outlines(const std::array<Real, 2 * n_azimuths>& reach) {
  std::array<PlaneMoments, 2> sets;
  for (int k = 0; rank() == 0 && k < n_azimuths; ++k) {
    const Real c = std::cos(2 * pi * k / n_azimuths), s = std::sin(2 * pi * k / n_azimuths);
    const Real outer = reach[k], inner = -reach[n_azimuths + k];
    if (outer < 0) continue;  // no surface at this azimuth
    sets[0].add(c * inner, s * inner, 1), sets[1].add(c * outer, s * outer, 1);
  }
  return PlaneMoments::fit(sets);
}

}  // namespace

RingFrame ring_frame(const Vec3& n, const Vec3& previous_zeta) {
  constexpr Real along = 0.99;  // cosine from which on the axis counts as parallel to z
  Vec3 zeta = previous_zeta;
  if (zeta == Vec3{}) zeta = std::abs(n.z) < along ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
  zeta = unit_across(zeta, n);
  return {zeta, cross(n, zeta), n};
}

Ring ring(const Surface& surface, const Vec3& centroid, const RingFrame& frame) {
  std::array<PlaneMoments, 4> sections;
  std::array<Real, 2 * n_azimuths> reach;  // largest rho, largest -rho
  reach.fill(-std::numeric_limits<Real>::max());
  for (Index f = 0; f < surface.size(); ++f) {
    std::array<Vec3, 3> q;
    for (int i = 0; i < 3; ++i) {
      const Vec3 r = surface.facet(f)[i] - centroid;
      q[i] = {dot(r, frame.zeta), dot(r, frame.eta), dot(r, frame.xi)};
    }
    cut(q, [&](int k, const Point& a, const Point& b) {
      reach[k] = std::max({reach[k], a.rho, b.rho});
      reach[n_azimuths + k] = std::max({reach[n_azimuths + k], -a.rho, -b.rho});
      if (k % quarter != 0) return;
      // three points of Gauss, exact for the moments of a segment, whatever its length
      const Real length = std::hypot(a.rho - b.rho, a.xi - b.xi), g = std::sqrt(0.15);
      for (const auto& [t, w] :
           {std::pair{0.5 - g, 5 / 18.0}, {0.5, 8 / 18.0}, {0.5 + g, 5 / 18.0}})
        sections[k / quarter].add(a.rho + t * (b.rho - a.rho), a.xi + t * (b.xi - a.xi),
                                  w * length);
    });
  }
  largest_of_ranks(reach);
  const auto tube = PlaneMoments::fit(sections);
  const auto outline = outlines(reach);
  Ring result;
  result.right = tube[0], result.forward = tube[1], result.left = tube[2], result.back = tube[3];
  result.inner = outline[0], result.outer = outline[1];
  result.bending_meridian = bending(result.forward, result.back);
  result.bending_prime = bending(result.right, result.left);
  return result;
}

}  // namespace fsi::analysis
